"""Doors that were found, compared with plans and with labels."""
