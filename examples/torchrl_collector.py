"""A TorchRL collector on the vector environment, and PPO on what it collects.

One sees, for each batch, decisions, mean reward of a decision and the episodes that succeeded. The
few decisions of the default show that it runs.

    pip install "semnav-env[rl]" torchrl
    python examples/torchrl_collector.py --steps 200000
"""

import argparse
import sys
from dataclasses import replace

from semnav_env.vector import SemNavVectorEnv
from semnav_env.world.lidar import TIM561

try:
    import torch
    from tensordict.nn import AddStateIndependentNormalScale, TensorDictModule
    from torch import nn
    from torchrl.collectors import Collector
    from torchrl.data import Unbounded
    from torchrl.envs import CatTensors, GymWrapper, TransformedEnv, default_info_dict_reader
    from torchrl.modules import IndependentNormal, ProbabilisticActor, ValueOperator
    from torchrl.objectives import ClipPPOLoss
    from torchrl.objectives.value import GAE
except ModuleNotFoundError as error:
    sys.exit(f'this example needs {error.name}: pip install "semnav-env[rl]" torchrl')

ROBOTS, HORIZON, EPOCHS, BATCH = 8, 128, 10, 256
SEEN = ["goal", "odometry", "scan"]


def make() -> TransformedEnv:
    """Robots that decide five times a second; the entries that are seen, as one vector."""
    envs = SemNavVectorEnv(
        ROBOTS,
        robot="spot",
        observation="all",
        task="go through the first door on the right",
        lidar=replace(TIM561, rate_hz=5.0),
        max_seconds=30.0,
        autoreset_mode="Disabled",  # TorchRL resets the robots whose episode is over
    )
    wrapped = GymWrapper(envs)
    told = {"is_success": Unbounded(ROBOTS, dtype=torch.bool)}
    wrapped.set_info_dict_reader(default_info_dict_reader(["is_success"], told))
    return TransformedEnv(wrapped, CatTensors(SEEN, "observation"))


def network(outputs: int) -> nn.Sequential:
    """Two layers of 64 units, on inputs squashed into [-1, 1]."""
    layers = nn.LazyLinear(64), nn.Tanh(), nn.Linear(64, 64), nn.Tanh(), nn.Linear(64, outputs)
    return nn.Sequential(nn.Softsign(), *layers)


def main(decisions: int) -> None:
    """Train for about so many decisions."""
    torch.manual_seed(0)
    torch.set_num_threads(1)
    envs = make()
    envs.set_seed(0)
    size = envs.action_spec.shape[-1]
    mean = nn.Sequential(network(size), AddStateIndependentNormalScale(size, scale_lb=0.05))
    actor = ProbabilisticActor(
        TensorDictModule(mean, ["observation"], ["loc", "scale"]),
        in_keys=["loc", "scale"],
        distribution_class=IndependentNormal,
        return_log_prob=True,
    )
    critic = ValueOperator(network(1), ["observation"])
    for part in (actor, critic):
        part(envs.reset())
    advantage = GAE(gamma=0.99, lmbda=0.95, value_network=critic)
    loss = ClipPPOLoss(actor, critic, entropy_coeff=0.003, normalize_advantage=True)
    optimiser = torch.optim.Adam(loss.parameters(), lr=3e-4)
    size = ROBOTS * HORIZON
    total = max(1, decisions // size) * size
    done = 0
    options = {"total_frames": total, "auto_register_policy_transforms": False}
    for batch in Collector(envs, actor, frames_per_batch=size, **options):
        advantage(batch)
        rows = batch.reshape(-1)
        for chosen in torch.cat([torch.randperm(size) for _ in range(EPOCHS)]).split(BATCH):
            terms = loss(rows[chosen])
            optimiser.zero_grad()
            sum(value for name, value in terms.items() if name.startswith("loss_")).backward()
            nn.utils.clip_grad_norm_(loss.parameters(), 0.5)
            optimiser.step()
        done += size
        over = rows["next", "done"].flatten()
        won = rows["next", "is_success"].flatten()[over]
        reward = rows["next", "reward"].mean().item()
        print(f"{done} decisions: reward {reward:+.4f}, success {won.sum()} of {len(won)}")


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--steps", type=int, default=2048, help="decisions, all robots")
    main(parser.parse_args().steps)
