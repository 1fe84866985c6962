"""The map in the picture: scan, memory and goal, over the floor plan."""

from __future__ import annotations

import math

import numpy as np

from semnav_env.mind.grounding.goal import Goal, PassGoal, SeekGoal, StopGoal, door_of
from semnav_env.rendering import marks, palette
from semnav_env.rendering.body import draw_body
from semnav_env.rendering.camera import Camera, Viewport
from semnav_env.rendering.canvas import Canvas
from semnav_env.rendering.depth_layer import draw_depth
from semnav_env.rendering.frame import Frame
from semnav_features.frames import FloatArray, Point
from semnav_features.scene import Door, Scene

DRAWN_BEAMS = 90
"""Approximate number of evenly spaced beams of a dense scan that are drawn; more would blur."""

DRAWN_HITS = 270
"""Approximate number of hits of a dense scan that are drawn."""


def draw_map(canvas: Canvas, camera: Camera, frame: Frame) -> None:
    """Draw everything but the floor plan, faint things first."""
    with canvas.highlighter():
        if len(frame.looked):
            canvas.discs(camera.pixels(frame.looked), 0.055 * camera.scale, palette.LOOKED)
        _draw_beams(canvas, camera, frame)
        for wall in frame.scene.walls:
            marks.wall_seen(canvas, camera.pixels([wall.start, wall.end]))
        if frame.goal is not None and (door := door_of(frame.goal)) is not None:
            canvas.stroke(camera.pixels([door.start, door.end]), palette.GOAL_DOORWAY, 24.0)
    for hinge_x, hinge_y, tip_x, tip_y in frame.leaves:
        marks.leaf(canvas, camera.pixels([(hinge_x, hinge_y), (tip_x, tip_y)]), camera.scale)
    _draw_lines(canvas, camera, frame)
    _draw_remembered(canvas, camera, frame.remembered)
    if frame.hits is not None:
        marks.hits(canvas, camera.pixels(_thinned(frame.hits, DRAWN_HITS)))
    _draw_seen(canvas, camera, frame.scene)
    if len(frame.cloud):
        draw_depth(canvas, camera, frame.cloud, frame.jambs)
    for x, y, radius in frame.people:
        marks.person(canvas, camera.pixel((x, y)), radius * camera.scale)
    for flag in frame.flags:
        marks.flag(canvas, camera.pixel((float(flag[0]), float(flag[1]))))
    draw_body(canvas, camera, frame.robot, frame.pose, frame.in_contact)
    if frame.goal is not None:
        _draw_goal(canvas, camera, frame.goal, frame.pose[:2])
    for index, number in frame.door_numbers.items():
        marks.badge(canvas, _badge_place(camera, frame.remembered.doors[index]), number)


def draw_scale_bar(canvas: Canvas, camera: Camera, view: Viewport) -> None:
    """Draw a scale of two metres at the lower left, on a plate that covers what lies there."""
    x, y = view.left + 18, view.top + view.height - 18
    end = x + 2.0 * camera.scale
    canvas.box(Viewport(x - 9, y - 20, end - x + 18, 29), palette.PANEL, 5.0)
    canvas.stroke([(x, y), (end, y)], palette.MUTED, 2.0)
    for tick in (x, end):
        canvas.stroke([(tick, y - 4), (tick, y + 4)], palette.MUTED, 2.0)
    canvas.text(((x + end) / 2, y - 11), "2 m", palette.MUTED, 11.0, centred=True)


def _draw_beams(canvas: Canvas, camera: Camera, frame: Frame) -> None:
    if frame.lidar is None or frame.hits is None or len(frame.hits) == 0:
        return
    lidar, ends = camera.pixel(frame.lidar), camera.pixels(frame.hits)
    canvas.polygon(np.vstack((lidar, ends)), palette.FAN)
    canvas.rays(lidar, _thinned(ends, DRAWN_BEAMS), palette.BEAM, 0.6)


def _thinned(points: FloatArray, drawn: int) -> FloatArray:
    return points[:: max(1, len(points) // drawn)]


def _draw_lines(canvas: Canvas, camera: Camera, frame: Frame) -> None:
    if frame.route is not None:
        marks.route(canvas, camera.pixels(frame.route))
    if frame.trail is not None:
        marks.trail(canvas, camera.pixels(frame.trail))


def _draw_remembered(canvas: Canvas, camera: Camera, scene: Scene) -> None:
    for wall in scene.walls:
        marks.wall_remembered(canvas, camera.pixels([wall.start, wall.end]))
    for door in scene.doors:
        marks.door_remembered(canvas, camera.pixels([door.start, door.end]))


def _draw_seen(canvas: Canvas, camera: Camera, scene: Scene) -> None:
    for corridor in scene.corridors:
        marks.corridor(canvas, camera.pixel(corridor.start), camera.pixel(corridor.end))
    for door in scene.doors:
        marks.door_seen(canvas, camera.pixels([door.start, door.end]))
    for corner in scene.corners:
        marks.corner(canvas, camera.pixel(corner.point), corner.kind)


def _badge_place(camera: Camera, door: Door) -> Point:
    """Place of a badge just behind an opening: right of start-end, away from the lidar."""
    (x1, y1), (x2, y2) = camera.pixels([door.start, door.end])
    length = math.hypot(x2 - x1, y2 - y1) or 1.0
    away = 2.2 * marks.BADGE_RADIUS / length
    return (x1 + x2) / 2 - away * (y2 - y1), (y1 + y2) / 2 + away * (x2 - x1)


def _draw_goal(canvas: Canvas, camera: Camera, goal: Goal, robot: Point) -> None:
    foot = camera.pixel(goal.pose[:2])
    heading = math.cos(goal.pose[2]), -math.sin(goal.pose[2])
    if isinstance(goal, StopGoal):
        marks.stop_sign(canvas, foot)
        return
    start, reach = foot, 34.0
    if isinstance(goal, PassGoal):
        start = camera.pixel(goal.door.midpoint)
    canvas.dashes([camera.pixel(robot), start], palette.GOAL, 1.0, dash=2.0, gap=5.0)
    tip = foot[0] + reach * heading[0], foot[1] + reach * heading[1]
    marks.arrow(canvas, start, tip, palette.GOAL)
    if isinstance(goal, SeekGoal):
        canvas.discs([foot], 11.0, palette.WHITE)
        canvas.ring(foot, 10.0, palette.GOAL, 2.0)
        canvas.text(foot, "?", palette.GOAL, 14.0, bold=True, centred=True)
    else:
        marks.flag(canvas, foot)
