"""The rules of the filters, one file for each stage."""
