"""Pictures of an episode: a frame goes in, pixels, a window or a film come out."""

from semnav_env.rendering.frame import Frame
from semnav_env.rendering.video import save_gif, save_mp4, save_png, save_video
from semnav_env.rendering.viewer import Viewer

__all__ = ["Frame", "Viewer", "save_gif", "save_mp4", "save_png", "save_video"]
