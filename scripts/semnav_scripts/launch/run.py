#!/usr/bin/env python3
"""Runs a sub-command of `semnav` for roslaunch and rosrun, whose remappings rospy reads itself."""

import sys

from semnav_scripts.main import main

if __name__ == "__main__":
    raise SystemExit(main([word for word in sys.argv[1:] if ":=" not in word]))
