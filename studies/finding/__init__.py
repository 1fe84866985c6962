"""Three ways of finding somebody in a house, compared: look around, look from places, and call."""
