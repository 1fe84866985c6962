"""How soon the node of a robot answers a scan."""
