"""Agents that drive: scripted, oracle and learned, behind one interface."""
