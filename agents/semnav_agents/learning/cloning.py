"""Behaviour cloning: a policy and its value function learn from demonstrations."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

import torch
from torch import Tensor

from semnav_agents.learning.imitation import Tensors, pauses
from semnav_agents.learning.mirrored import mirrored_actions, mirrored_observations

if TYPE_CHECKING:
    from stable_baselines3 import PPO

EPOCHS, BATCH_SIZE, LEARNING_RATE = 40, 512, 2e-3
"""Passes over the demonstrations, decisions in a gradient step, and the largest step size."""

HUBER_BETA = 0.2
"""Error of an action beyond which the loss grows linearly: a planner's choices are discrete."""

VALUE_WEIGHT = 0.01
"""Weight of the squared error of the value beside the error of the actions."""


def clone(model: PPO, demonstrations: Tensors, seed: int) -> Iterator[float]:
    """Teach the mean of the policy the actions, and the value function the returns.

    Half of the batches, chosen at random, are mirrored: left and right are exchanged.

    Args:
        model: the model whose weights are changed.
        demonstrations: "observations", "actions" and "returns", a row for each decision.
        seed: of the order of the decisions.

    Yields:
        The mean loss of each of `EPOCHS` passes, on the training data.
    """
    kept = ~pauses(demonstrations)
    parts = [demonstrations[name][kept] for name in ("observations", "actions", "returns")]
    other = [mirrored_observations(parts[0]), mirrored_actions(parts[1]), parts[2]]
    both = [[torch.from_numpy(part) for part in each] for each in (parts, other)]
    count = len(parts[0])
    batches = max(1, count // BATCH_SIZE)
    order = torch.Generator().manual_seed(seed)
    optimizer = torch.optim.Adam(model.policy.parameters(), LEARNING_RATE)
    schedule = torch.optim.lr_scheduler.OneCycleLR(
        optimizer, LEARNING_RATE, total_steps=EPOCHS * batches, pct_start=0.15
    )
    for _ in range(EPOCHS):
        losses = []
        for rows in torch.randperm(count, generator=order).chunk(batches):
            side = int(torch.randint(2, (), generator=order))
            loss = _loss(model, *(part[rows] for part in both[side]))
            optimizer.zero_grad()
            torch.autograd.backward(loss)
            optimizer.step()
            schedule.step()
            losses.append(loss.item())
        yield sum(losses) / len(losses)


def _loss(model: PPO, observations: Tensor, actions: Tensor, returns: Tensor) -> Tensor:
    """The error of a batch; for a body that cannot move sideways, that part does not count."""
    policy = model.policy
    hidden, hidden_value = policy.mlp_extractor(observations)
    wanted, values = policy.action_net(hidden), policy.value_net(hidden_value).flatten()
    error = torch.nn.functional.smooth_l1_loss(wanted, actions, beta=HUBER_BETA, reduction="none")
    if actions.shape[1] == 3:
        weights = torch.ones_like(error)
        weights[:, 1] = observations[:, 0]
        error = error * weights
    loss = error.sum(dim=1).mean()
    return loss + VALUE_WEIGHT * torch.nn.functional.mse_loss(values, returns)
