"""The learned reader: masks values, translates, ranks, and acts, asks or refuses."""
