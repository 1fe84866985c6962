"""The words that people say, by their classes: numerals, names of rooms, slips of the pen."""
