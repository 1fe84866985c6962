"""How fast the environment is on this machine: `semnav bench`."""
