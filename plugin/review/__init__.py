"""The dock *Bare Earth > Review*: places to review are answered one after another."""
