"""A robot's own node in ROS 2, such as `ros2 launch FOLDER/node.launch.py robot:=spot`."""

from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument, ExecuteProcess
from launch.substitutions import LaunchConfiguration

OPTIONS = {
    "robot": ("wheelchair", "wheelchair or spot"),
    "agent": ("scripted", "what drives"),
    "mount": ("None", "x,y,heading of the lidar in the base frame; None: from tf_static"),
    "base": ("0.0", "x of the base frame in the robot frame, metres"),
    "base_frame": ("base_link", "name of the base frame"),
    "language": ("None", "en or de; None: recognised for each text"),
    "navigator": ("None", "action (nav2) or topic (goal_pose); None: the agent drives"),
    "action": ("None", "name of the action; None: navigate_to_pose"),
}
TOPICS = {
    "scan": "topic of the scans",
    "odom": "topic of odometry",
    "cmd_vel": "topic of velocities",
    "goal_pose": "topic of goals, for navigator:=topic",
}


def generate_launch_description() -> LaunchDescription:
    """`semnav node` with an argument for each option, and for the topics of the robot."""
    arguments = OPTIONS | {name: (name, said) for name, said in TOPICS.items()}
    declared = [
        DeclareLaunchArgument(name, default_value=value, description=said)
        for name, (value, said) in arguments.items()
    ]
    options = [[f"--{name.replace('_', '-')}=", LaunchConfiguration(name)] for name in OPTIONS]
    topics = [[f"{name}=", LaunchConfiguration(name)] for name in TOPICS]
    command = ["semnav", "node", "--over=ros2", *options, "--topics", *topics]
    return LaunchDescription([*declared, ExecuteProcess(cmd=command, output="screen")])
