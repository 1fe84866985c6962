"""A learned translator from words to commands, and the interpreter that asks with it."""
