"""The rules by which a command is grounded and judged: every tolerance stands here, once.

Robot and judge follow the same `Rules`, so what the robot counts as the second door is what the
judge counts. docs/rules.md lists them.
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
    """What the words of a command refer to, and from where a robot looks for it.

    Attributes:
        stand_off: distance from a door at which the robot's centre stands before or behind it,
            metres: room for a body to face the door without touching it.
        doorway_exit: distance that a robot drives out of a doorway before it turns, metres: so far
            its body is clear of the jambs.
        look_ahead: distance ahead of the robot at which the goal of a search lies, metres: well
            within a lidar's range.
        end_margin: distance before the end of a corridor at which the robot stops, metres: room to
            turn on the spot.
        lookout_distance: distance at which a lookout point counts as reached, metres: more than
            the 0.4 m within which a driver takes a place as reached.
        inspection_angle: heading error within which a direction counts as inspected, radians: less
            than half of the field of view of any lidar.
        door_offset: largest distance between a door and the side of a corridor that it lies on,
            metres: a deep frame or a recess.
        end_door_offset: largest distance between a door and the end of a corridor that it lies at,
            metres.
        abreast_distance: doors that lie nearer to each other along a corridor are not one before
            the other, metres: a third of a door's width.
        behind_angle: doors whose directions differ by less are equally straight behind, radians.
        corridor_width: the widest corridor, metres; what is wider has a wall behind the robot, as
            a room has.
        same_door_distance: doors whose midpoints are nearer are one door, metres: less than the
            narrowest door.
        other_wall_distance: a door farther behind the line of another door is in another wall,
            metres: more than walls are thick.
        leading_out_depth: free depth behind a door that leads out of a room, metres, at least: less
            than any corridor is wide.
        sightings_ratio: a door seen so many times less often than another one is doubtful.
        doorway_depth: a robot stands in a doorway that lies no farther ahead than this, metres.
        opposite_door_distance: farthest door that is opposite a door, metres: across a wide hall.
        opposite_robot_distance: farthest door that is opposite the robot, metres: across a
            corridor.
        across_distance: a robot so far out of a doorway has seen what is opposite it, metres: the
            jambs no longer hide anything.
        lookout_step: distance out of a doorway of the place to look across from, metres: beyond
            `across_distance` by what a driver may stop short of.
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
        way_door_depth: largest distance of a seen door from where it was pointed out, in the
            direction through it, metres: odometry drifts.
        way_door_offset: the same distance along the wall, metres: less than from door to door.
        way_door_angle: largest angle between a seen door and the one pointed out, radians.
        way_door_passed: a robot farther behind a door faces another one, metres: less than half a
            corridor.
        places_ahead: number of places farther on that a robot on a known way heads for.
        way_drift: largest distance beside a known way that the robot keeps to, metres: what
            odometry drifts by.
        straight_way_angle: a known way that turns by less leads straight on, radians.
        jamb_margin: distance beside a seen jamb at which a crossing still counts for the robot, and
            behind the door that the robot must be, metres: seen jambs are not exact.
        care: share of a success tolerance within which the robot itself takes a goal as reached,
            so that it aims well inside what the judge accepts.
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
    way_door_depth: Length = 1.5
    way_door_offset: Length = 1.0
    way_door_angle: Angle = math.radians(30.0)
    way_door_passed: Length = 0.5
    places_ahead: Count = 2
    way_drift: Length = 1.5
    straight_way_angle: Angle = 0.6
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
    """What the judge accepts; distances are of the robot's centre.

    Attributes:
        door_distance: largest distance from the place before a door of "go to the door", metres:
            less than to the place before the next door.
        door_heading: largest heading error there, radians.
        junction_distance: largest distance from the place inside the arm after a turn, metres: all
            of an arm's width.
        turn_distance: largest distance from where a turn on the spot was begun, metres: a body
            may need room to turn.
        turn_heading: largest heading error after a turn, radians: less than between two arms.
        turn_heading_min: least heading error that is accepted after a turn by some degrees,
            radians: what odometry is off by; above it half of the angle, up to `turn_heading`.
        corridor_distance: largest distance from the end of "follow the hallway", metres.
        way_distance: largest distance along the way from the end of a known way, metres.
        way_offset: largest distance beside the end of a known way, metres: odometry has drifted on
            a long way.
        standstill_speed: below it the robot has stopped, as "stop" asks, m/s.
        still_speed: below it and `still_yaw_rate` the robot stands still, which ends an episode
            after a while, m/s.
        still_yaw_rate: the same for turning, rad/s.
        still_seconds: longest time of standing still, beyond what a clause asks for, seconds.
        final_still_seconds: standing still for longer when time runs out is stopping short,
            seconds.
        search_rest_seconds: a robot that has not moved from its place for so long during a search
            says that it has finished, seconds: longer than it takes to look all around and to plan
            anew where no way leads on.
        wrong_arm_depth: a robot farther inside an arm that the clause does not name has taken a
            wrong turn, metres: its body has left the corridor.
        missed_turn_distance: a robot farther behind the junction at which it was to turn has taken
            a wrong turn, metres: twice `wrong_arm_depth`.
        passed_arm_distance: an arm counts as passed, and is no wrong turn, if its far edge lies no
            farther ahead than this of where the clause began, metres.
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
    wrong_arm_depth: Length = 1.2
    missed_turn_distance: Length = 2.4
    passed_arm_distance: Length = 0.5

    def __post_init__(self) -> None:
        check_fields(self)


@dataclass(frozen=True, slots=True)
class Rules:
    """Everything that robot and judge must agree on.

    Attributes:
        door: what counts as a door.
        grounding: what the words of a command refer to.
        success: what the judge accepts.
    """

    door: DoorRules = field(default_factory=DoorRules)
    grounding: GroundingRules = field(default_factory=GroundingRules)
    success: SuccessRules = field(default_factory=SuccessRules)

    def __post_init__(self) -> None:
        check_fields(self)


def with_doors_of(rules: Rules, extractor: ExtractorSettings) -> tuple[Rules, ExtractorSettings]:
    """Rules and extractor settings with the same doors, whichever of the two says what those are.

    Raises:
        ValueError: one of them is something else, or both say what a door is, and differently.
    """
    check_kind("extractor", extractor, ExtractorSettings)
    check_kind("rules", rules, Rules)
    usual, seen = DoorRules(), extractor.door_rules
    if rules.door != usual and seen not in (usual, rules.door):
        raise ValueError(f"rules.door is {rules.door}, but the extractor's doors are {seen}")
    door = seen if rules.door == usual else rules.door
    return replace(rules, door=door), extractor.with_doors(door)
