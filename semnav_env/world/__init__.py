"""The world: floor plans, physics, lidar, depth cameras, people, and the simulator of them all."""
