"""The rules by which a command is grounded and judged, with every tolerance.

Robot and judge follow the same `Rules`, so both count the same door as the second one.
docs/concepts/rules.md lists all rules.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field, replace
from typing import Annotated

from semnav_features.checked_fields import Angle, Bounds, Count, Length, Share, check_fields
from semnav_features.rules import DoorRules
from semnav_features.settings import ExtractorSettings
from semnav_features.validation import check_kind


@dataclass(frozen=True, slots=True)
class GroundingRules:
    """Distances and angles by which a robot finds the referents of words, and looks for them.

    Attributes:
        stand_off: distance from a door at which the robot's centre stands before or behind it,
            metres: room for a body to face the door without touching it.
        doorway_exit: distance that a robot drives out of a doorway before it turns, metres: its
            body is then clear of the jambs.
        look_ahead: distance ahead of the robot at which the goal of a search lies, metres: well
            within a lidar's range.
        end_margin: distance before the end of a corridor at which the robot stops, metres: room to
            turn on the spot.
        lookout_distance: distance at which a lookout point counts as reached, metres: more than
            the 0.4 m within which an agent takes a place as reached.
        inspection_angle: heading error within which a direction counts as inspected, radians: less
            than half of the field of view of any lidar.
        door_offset: largest distance between a door and the side of a corridor that it lies on,
            metres: a deep frame or a recess.
        end_door_offset: largest distance between a door and the end of a corridor that it lies at,
            metres.
        abreast_distance: two doors whose distance along a corridor is smaller than this have no
            order, metres: a third of a door's width.
        behind_angle: doors whose directions differ by less than this are equally straight behind,
            radians.
        corridor_width: the widest corridor, metres; a wider place is treated as a room, which has
            a wall behind the robot.
        same_door_distance: doors whose midpoints are nearer than this are one door, metres: less
            than the narrowest door.
        other_wall_distance: a door farther than this behind the line of another door is in another
            wall, metres: more than the thickness of walls.
        leading_out_depth: least free depth behind a door that leads out of a room, metres: less
            than the width of any corridor.
        sightings_ratio: a door is doubtful if another one was seen this many times as often.
        doorway_depth: largest distance to a doorway ahead in which a robot stands, metres.
        opposite_door_distance: farthest door that is opposite a door, metres: across a wide hall.
        opposite_robot_distance: farthest door that is opposite the robot, metres: across a
            corridor.
        across_distance: distance out of a doorway at which a robot has seen what is opposite it,
            metres: the jambs no longer hide anything.
        lookout_step: distance out of a doorway of the place from which to look across, metres:
            more than `across_distance`, because an agent may stop short of it.
        arm_depth: distance inside the arm of a junction at which a turn ends, metres.
        junction_ahead: a junction counts while its far edge is farther ahead than this, metres.
        before_door: distance before the middle of a door at which "until the door" ends, so that
            the door still counts afterwards, metres.
        behind_referent: distance behind a junction, or the middle of a door, at which "past" it
            ends, so that it no longer counts, metres.
        beside_doorway: distance beside the doorway that the robot turns away from at which counting
            begins, so that this doorway does not count, metres: half of a door's width.
        faced_door_distance: a door no farther ahead than this is the one that a robot turns away
            from, metres.
        beside_distance: a door farther than this from a place, along the hallway, is not beside it,
            metres: about as far as from one office door to the next.
        some_distance: length of "a bit" and "a short way", metres: some three steps.
        way_door_depth: largest distance between a seen door and the told place of the door, in the
            direction through it, metres: odometry drifts.
        way_door_offset: the same distance along the wall, metres: less than from door to door.
        way_door_angle: largest angle between a seen door and the told door, radians.
        way_door_passed: a robot farther than this behind a door faces another one, metres: less
            than half the width of a corridor.
        places_ahead: number of places along a known way that the robot's target is ahead.
        way_drift: largest offset from a known way that the robot keeps, metres: the drift of
            odometry.
        straight_way_angle: a known way that turns by less than this leads straight on, radians.
        wall_distance: distance of the robot's centre from the wall along which it keeps, metres:
            half a body and room to drive at its usual speed.
        jamb_margin: distance beside a seen jamb at which a crossing still counts for the robot, and
            behind the door that the robot must be, metres: seen jambs are not exact.
        care: share of a success tolerance within which the robot itself takes a goal as reached;
            the robot must be well inside the tolerance of the judge.
    """

    stand_off: Length = 0.9
    doorway_exit: Length = 1.0
    look_ahead: Length = 4.0
    end_margin: Length = 1.0
    lookout_distance: Length = 0.45
    inspection_angle: Angle = math.radians(40.0)
    door_offset: Length = 0.25
    end_door_offset: Length = 0.6
    abreast_distance: Length = 0.3
    behind_angle: Angle = math.radians(6.0)
    corridor_width: Length = 3.0
    same_door_distance: Length = 0.5
    other_wall_distance: Length = 0.3
    leading_out_depth: Length = 1.0
    sightings_ratio: Annotated[float, Bounds(1.0, 1e6)] = 4.0
    doorway_depth: Length = 0.25
    opposite_door_distance: Length = 8.0
    opposite_robot_distance: Length = 5.0
    across_distance: Length = 0.5
    lookout_step: Length = 1.0
    arm_depth: Length = 1.0
    junction_ahead: Length = 0.5
    before_door: Length = 0.3
    behind_referent: Length = 0.3
    beside_doorway: Length = 0.5
    faced_door_distance: Length = 2.0
    beside_distance: Length = 5.0
    some_distance: Length = 2.0
    way_door_depth: Length = 1.5
    way_door_offset: Length = 1.0
    way_door_angle: Angle = math.radians(30.0)
    way_door_passed: Length = 0.5
    places_ahead: Count = 2
    way_drift: Length = 1.5
    straight_way_angle: Angle = 0.6
    wall_distance: Length = 0.6
    jamb_margin: Length = 0.3
    care: Share = 0.5

    def __post_init__(self) -> None:
        check_fields(self)

    @property
    def seen_end_distance(self) -> float:
        """Distance from its end at which a corridor has been seen to its end, metres."""
        return self.end_margin + self.lookout_distance


@dataclass(frozen=True, slots=True)
class SuccessRules:
    """Tolerances of the judge; distances are those of the robot's centre.

    Attributes:
        door_distance: largest distance from the place before a door of "go to the door", metres:
            less than to the place before the next door.
        door_heading: largest heading error there, radians.
        junction_distance: largest distance along an arm from the place inside it after a turn,
            metres; and across the arm, where that is not wider.
        turn_distance: largest distance from the pose at which a turn on the spot began, metres: a
            body may need room to turn.
        turn_heading: largest heading error after a turn, radians: less than between two arms.
        turn_heading_min: least heading error that is accepted after a turn by some degrees,
            radians: the error of odometry; for larger angles half of the angle, up to
            `turn_heading`.
        corridor_distance: largest distance from the end of "follow the hallway", metres.
        way_distance: largest distance along the way from the end of a known way, metres.
        way_offset: largest distance beside the end of a known way, metres: odometry has drifted on
            a long way.
        standstill_speed: speed below which the robot has carried out "stop", m/s.
        still_speed: speed below which the robot stands still, if it also turns slower than
            `still_yaw_rate`, m/s; standing still ends an episode after `still_seconds`.
        still_yaw_rate: yaw rate below which the robot stands still, rad/s.
        still_seconds: longest time of standing still, in addition to that of the clause, seconds.
        final_still_seconds: a robot that has stood still for longer than this when time runs out
            has stopped short, seconds.
        search_rest_seconds: time without motion after which a robot that searches says that it has
            finished, seconds: longer than it needs to look all around and to plan again where
            there is no path.
        finding_rest_seconds: the same of one that looks around, calls, goes to a person or asks,
            seconds: longer than it needs to turn on the spot once.
        wrong_arm_depth: a robot farther than this inside an arm that the clause does not name has
            taken a wrong turn, metres: its body has left the corridor.
        missed_turn_distance: a robot farther than this behind the junction at which it should turn
            has taken a wrong turn, metres: twice `wrong_arm_depth`.
        wall_share: least share of the way that the robot drives on the side of the hallway's middle
            along whose wall it is to keep.
        wall_entry: the way in the hallway that does not count for that, metres: the robot gets over
            to the wall.
        wall_least: a way there that is shorter after that does not count either, metres.
        wall_room: a hallway counts for that if its sides are this much farther from its middle than
            `wall_distance`, metres: in a narrower one no side can be told.
        door_doubt: an opening that is wider than `DoorRules.width_max`, or narrower than
            `width_min`, by up to this may be a door or not, metres: three times `width_tolerance`.
            What is right in either case is accepted.
        passed_arm_distance: an arm counts as passed, and not as a wrong turn, if its far edge lies
            no farther than this ahead of the pose at which the clause began, metres.
    """

    door_distance: Length = 0.7
    door_heading: Angle = 0.6
    junction_distance: Length = 1.6
    turn_distance: Length = 1.5
    turn_heading: Angle = 0.5
    turn_heading_min: Angle = 0.2
    corridor_distance: Length = 1.0
    way_distance: Length = 1.0
    way_offset: Length = 1.5
    standstill_speed: Annotated[float, Bounds(0.0, 10.0, "m/s")] = 0.05
    still_speed: Annotated[float, Bounds(0.0, 10.0, "m/s")] = 0.02
    still_yaw_rate: Annotated[float, Bounds(0.0, 20.0, "rad/s")] = 0.02
    still_seconds: Annotated[float, Bounds(0.0, 1e6, "s")] = 10.0
    final_still_seconds: Annotated[float, Bounds(0.0, 1e6, "s")] = 1.0
    search_rest_seconds: Annotated[float, Bounds(0.0, 1e6, "s")] = 20.0
    finding_rest_seconds: Annotated[float, Bounds(0.0, 1e6, "s")] = 10.0
    wrong_arm_depth: Length = 1.2
    missed_turn_distance: Length = 2.4
    wall_share: Share = 0.5
    wall_entry: Length = 2.0
    wall_least: Length = 1.0
    wall_room: Length = 0.1
    door_doubt: Length = 0.15
    passed_arm_distance: Length = 0.5

    def __post_init__(self) -> None:
        check_fields(self)


@dataclass(frozen=True, slots=True)
class Rules:
    """All rules that robot and judge share.

    Attributes:
        door: widths of what counts as a door.
        grounding: distances and angles by which referents are found.
        success: tolerances of the judge.
    """

    door: DoorRules = field(default_factory=DoorRules)
    grounding: GroundingRules = field(default_factory=GroundingRules)
    success: SuccessRules = field(default_factory=SuccessRules)

    def __post_init__(self) -> None:
        check_fields(self)


def with_doors_of(rules: Rules, extractor: ExtractorSettings) -> tuple[Rules, ExtractorSettings]:
    """Return rules and extractor settings with the same door rules, taken from the changed one.

    Raises:
        ValueError: an argument has another type, or both have changed door rules that differ.
    """
    check_kind("extractor", extractor, ExtractorSettings)
    check_kind("rules", rules, Rules)
    usual, seen = DoorRules(), extractor.door_rules
    if rules.door != usual and seen not in (usual, rules.door):
        raise ValueError(f"rules.door is {rules.door}, but the extractor's doors are {seen}")
    door = seen if rules.door == usual else rules.door
    return replace(rules, door=door), extractor.with_doors(door)
