"""The four documents that the project is built from, item by item."""
