"""Launch files of ROS 1 and ROS 2, and what those of ROS 1 run."""
