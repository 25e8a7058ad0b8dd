"""How the layers of a run look: colours, legends, names and order in the tree of layers."""
