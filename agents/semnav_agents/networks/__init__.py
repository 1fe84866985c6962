"""The networks of the agents: where their files lie, and what their training in torch shares."""
