"""What the right answers to commands on real floors depend on."""
