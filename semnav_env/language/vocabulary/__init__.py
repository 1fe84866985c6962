"""Reads the words of people: from a text to the commands that it can mean."""
