"""The Processing algorithms: thin wrappers of the classifier, most of them made of declarations."""
