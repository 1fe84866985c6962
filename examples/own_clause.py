"""A clause of one's own, "back up 1 metre", and an interpreter that understands the words for it.

One sees what the interpreter takes two texts for, the judge's verdict, and what the robot took for
its goal.
"""

import re
from dataclasses import dataclass
from typing import ClassVar

from semnav_agents import make_agent
from semnav_agents.base import steps
from semnav_env.env import SemNavEnv
from semnav_env.language import Clause, Command, Follow, GrammarInterpreter, Interpretation
from semnav_env.language.declarations import Form, Multiples, form
from semnav_env.language.languages import english
from semnav_env.mind.grounding import Goal, GroundedClause, ReachGoal, Situation
from semnav_features.frames import compose


@dataclass(frozen=True)
class BackUp(GroundedClause):
    """Drive backwards, so many metres."""

    metres: int
    stand_in: ClassVar[Clause] = Follow()  # the token that a learner sees
    forms: ClassVar[tuple[Form, ...]] = (
        form(
            {
                "en": "back up {metres} metres",
                "en:one": "back up {metres} metre",
                "de": "fahr {metres} Meter zurück",
            },
            metres=Multiples(1, 9),
        ),
    )

    def goal(self, situation: Situation) -> Goal:
        """A place behind where the clause began; the heading stays as it is."""
        place = compose(situation.begin, (-float(self.metres), 0.0, 0.0))
        return ReachGoal(place, 0.4, 0.6, because=str(self))


class WithBackUp:
    """Understands "back up N metres", and leaves everything else to the grammar."""

    def interpret(self, text: str) -> Interpretation:
        """What a text means."""
        asked = re.fullmatch(r"back up (\d) metres?", text)
        if asked is None:
            return GrammarInterpreter().interpret(text)
        command = Command((BackUp(int(asked[1])),))
        return Interpretation(text, (command,), english(), "grammar")


def main() -> None:
    """Carry out one command of each kind."""
    for text in ("back up 1 metre", "go through the first door on the right"):
        command = WithBackUp().interpret(text).command
        agent = make_agent("scripted")
        env = SemNavEnv("spot", observation=agent.observation)
        start = env.reset(seed=0, options={"command": command, "pose": (-1.0, -0.1, 0.24)})
        *_, last = steps(env, agent, *start)
        kind, success = type(command.clauses[0]).__name__, last.info["is_success"]
        print(f"{kind}: success {success}, the robot's goal: {env.belief.reasons[0]}")


if __name__ == "__main__":
    main()
