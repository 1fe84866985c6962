"""A clause of one's own, "step aside by 1 metre", and an interpreter that knows the words for it.

One sees what the interpreter takes two texts for, the judge's verdict, and what the robot took for
its goal.
"""

import re
from dataclasses import dataclass
from typing import ClassVar

from semnav_agents import make_agent
from semnav_agents.base import steps
from semnav_env.env import SemNavEnv
from semnav_env.language import Clause, Command, Follow, Interpretation, LearnedInterpreter
from semnav_env.language.declarations import Form, Multiples, form
from semnav_env.language.languages import english
from semnav_env.mind.grounding import Goal, GroundedClause, ReachGoal, Situation
from semnav_features.frames import compose


@dataclass(frozen=True)
class StepAside(GroundedClause):
    """Move to the left without turning, so many metres."""

    metres: int
    stand_in: ClassVar[Clause] = Follow()  # the token that a learner sees
    forms: ClassVar[tuple[Form, ...]] = (
        form(
            {
                "en": "step aside by {metres} metres",
                "en:one": "step aside by {metres} metre",
                "de": "geh {metres} Meter zur Seite",
            },
            metres=Multiples(1, 9),
        ),
    )

    def goal(self, situation: Situation) -> Goal:
        """A place to the left of where the clause began; the heading stays as it is."""
        place = compose(situation.begin, (0.0, float(self.metres), 0.0))
        return ReachGoal(place, 0.4, 0.6, because=str(self))


class WithStepAside:
    """Understands "step aside by N metres", and leaves everything else to the usual reader."""

    def interpret(self, text: str) -> Interpretation:
        """What a text means."""
        asked = re.fullmatch(r"step aside by (\d) metres?", text)
        if asked is None:
            return LearnedInterpreter().interpret(text)
        command = Command((StepAside(int(asked[1])),))
        return Interpretation(text, command, english(), "own words")


def main() -> None:
    """Carry out one command of each kind."""
    for text in ("step aside by 1 metre", "go through the first door on the right"):
        command = WithStepAside().interpret(text).command
        agent = make_agent("scripted")
        env = SemNavEnv("spot", observation=agent.observation)
        start = env.reset(seed=0, options={"command": command, "pose": (-1.0, -0.1, 0.24)})
        *_, last = steps(env, agent, *start)
        kind, success = type(command.clauses[0]).__name__, last.info["is_success"]
        print(f"{kind}: success {success}, the robot's goal: {env.belief.reasons[0]}")


if __name__ == "__main__":
    main()
