"""How robust the speech parser is: fillers, missing punctuation, canonical words, long texts."""
