"""A listener that is trained and measured without the words: the learned floor of the listener."""
