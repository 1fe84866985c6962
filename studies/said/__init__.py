"""Commands to find people, in the words that people use."""
