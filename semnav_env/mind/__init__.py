"""The robot's side: what it believes, what a clause means there, and what an agent is shown."""
