"""How often robots get out of cluttered rooms through a named door."""
