"""A training of a few seconds."""

from dataclasses import replace

import numpy as np

from semnav_agents.learning.presets import PRESETS, PPOSettings
from semnav_agents.learning.training import Trainer

TINY = replace(
    PRESETS["hallway"],
    name="tiny",
    max_seconds=3.0,
    envs=2,
    steps=128,
    ppo=PPOSettings(hidden=(8,), rollout=32, batch_size=32, epochs=2, stretch=1),
)
ROLLOUT = TINY.envs * TINY.ppo.rollout


LONG = replace(TINY, name="long", ppo=replace(TINY.ppo, stretch=3))
"""A preset whose checkpoints are three updates apart."""


def train(folder, rollouts=1, seed=0, preset=TINY):
    return go_on(Trainer(preset, folder, seed), rollouts)


def go_on(trainer, rollouts):
    for _ in range(rollouts):
        trainer.save()
        trainer.advance()
    trainer.save()
    trainer.close()
    return trainer


def weights(trainer):
    return {name: w.numpy().copy() for name, w in trainer.model.policy.state_dict().items()}


def same(a, b):
    return a.keys() == b.keys() and all(np.array_equal(a[name], b[name]) for name in a)
