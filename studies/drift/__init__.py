"""What drift of odometry does to success, with and without correction."""
