"""The networks that agents run: their layers in NumPy, and the files that hold them."""
