"""Behaviour cloning: a policy learns the actions of demonstrations, and its value the returns."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from functools import partial
from pathlib import Path

import numpy as np
import torch
from gymnasium.spaces import Box
from numpy.typing import NDArray
from stable_baselines3.common.policies import ActorCriticPolicy
from torch import Tensor, nn

from studies.learning.command_envs import ACTION_SIZE, Array
from studies.learning.demonstrations import Lesson, demonstrations, first_of, is_taught
from studies.learning.heard_vector import LARGEST, SIZE
from studies.learning.ppo import CLONED_LOG_STD
from studies.learning.progress import Learned

PASSES, BATCH, RATE, DECAY = 12, 512, 1e-3, 0.01
"""Passes over the demonstrations, decisions in a gradient step, largest step size, weight decay."""

BETA, FINGER_SLOPE, FINGER_WEIGHT, MOVED_WEIGHT, VALUE_WEIGHT = 0.2, 4.0, 0.2, 5.0, 0.002
"""Error of an action beyond which the loss grows linearly; logit of a finger's action of 1; weights
of the finger's loss, of decisions in which it moves, and of the value's squared error."""

SHARES = (0.25, 0.5, 1.0)
"""Parts of the demonstrations from which policies are cloned, each from random weights."""


def train(seed: int, steps: int, folder: Path) -> Iterator[Learned]:
    """Clone parts of the demonstrations; gives the policy of each."""
    for share in SHARES:
        end = int(share * steps)
        policy = cloned(seed, end, folder, steps)
        yield Learned(end, partial(_decide, policy))


def cloned(seed: int, steps: int, folder: Path, all_steps: int) -> ActorCriticPolicy:
    """The policy that is cloned from the first demonstrations; it is kept in the folder."""
    policy, file = new_policy(seed), folder / f"cloned-{seed}-{steps}.pt"
    if file.exists():
        policy.load_state_dict(torch.load(file, weights_only=True))
        return policy
    lessons = first_of(demonstrations(all_steps, folder), steps)
    teach(policy, [each for each in lessons if each.success], seed, PASSES, RATE)
    torch.save(policy.state_dict(), file)
    return policy


def new_policy(seed: int) -> ActorCriticPolicy:
    """The network of `ppo.py`, with random weights."""
    torch.manual_seed(seed)
    spaces = (Box(-LARGEST, LARGEST, (SIZE,)), Box(-1.0, 1.0, (ACTION_SIZE,)))
    return ActorCriticPolicy(
        *spaces, lambda _: RATE, net_arch=[256, 256], log_std_init=CLONED_LOG_STD
    )


def teach(
    policy: ActorCriticPolicy, lessons: Sequence[Lesson], seed: int, passes: int, rate: float
) -> float:
    """Let a policy learn from lessons; returns the mean loss of the last pass."""
    taught = [is_taught(each) for each in lessons]
    vectors, actions, returns = (
        _joined(parts, taught)
        for parts in (
            [each.vectors for each in lessons],
            [each.actions for each in lessons],
            [each.returns for each in lessons],
        )
    )
    order = torch.Generator().manual_seed(seed)
    batches = max(1, len(vectors) // BATCH)
    optimizer = torch.optim.AdamW(policy.parameters(), rate, weight_decay=DECAY)
    schedule = torch.optim.lr_scheduler.OneCycleLR(optimizer, rate, total_steps=passes * batches)
    for _ in range(passes):
        losses = []
        for part in torch.randperm(len(vectors), generator=order).chunk(batches)[:batches]:
            loss = _loss(policy, vectors[part], actions[part], returns[part])
            optimizer.zero_grad()
            torch.autograd.backward(loss)
            optimizer.step()
            schedule.step()
            losses.append(loss.item())
    return float(np.mean(losses))


def _joined(parts: Sequence[Array], taught: Sequence[NDArray[np.bool_]]) -> Tensor:
    """The rows that are taught, one lesson after the other."""
    kept = [part[rows] for part, rows in zip(parts, taught, strict=True)]
    return torch.from_numpy(np.concatenate(kept))


def _loss(policy: ActorCriticPolicy, seen: Tensor, wanted: Tensor, returns: Tensor) -> Tensor:
    hidden, hidden_value = policy.mlp_extractor(seen)
    said, values = policy.action_net(hidden), policy.value_net(hidden_value)[:, 0]
    error = nn.functional.smooth_l1_loss(said[:, :-1], wanted[:, :-1], beta=BETA)
    moves = (wanted[:, -1] > 0).float()
    finger = nn.functional.binary_cross_entropy_with_logits(
        FINGER_SLOPE * said[:, -1], moves, weight=1.0 + (MOVED_WEIGHT - 1.0) * moves
    )
    value = nn.functional.mse_loss(values, returns)
    return error + FINGER_WEIGHT * finger + VALUE_WEIGHT * value


@torch.no_grad()
def act(policy: ActorCriticPolicy, seen: Array) -> Array:
    """The mean action."""
    hidden = policy.mlp_extractor.forward_actor(torch.from_numpy(seen))
    actions: Array = policy.action_net(hidden).numpy()
    return np.clip(actions, -1.0, 1.0)


def _decide(policy: ActorCriticPolicy, seen: Array, _: NDArray[np.bool_]) -> Array:
    return act(policy, seen)
