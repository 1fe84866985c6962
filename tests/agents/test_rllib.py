"""Training on RLlib with a local Ray of two runners."""

import os
import signal
import sys
from contextlib import suppress
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

pytest.importorskip("stable_baselines3", reason='needs the extra "rl"')
pytestmark = pytest.mark.filterwarnings("ignore")  # those of Ray

if "ray" not in sys.modules:
    # as `connect`, which must come before anything that imports Ray
    os.environ |= {"RAY_USAGE_STATS_ENABLED": "0", "RAY_ENABLE_WINDOWS_OR_OSX_CLUSTER": "0"}
ray = pytest.importorskip("ray", reason='needs the extra "ray", in an environment of its own')

from semnav_agents.learned import LearnedAgent  # noqa: E402
from semnav_agents.learning.compact import COMPACT_SIZE  # noqa: E402
from semnav_agents.learning.presets import PRESETS, PPOSettings  # noqa: E402
from semnav_agents.learning.rllib.options import RayOptions  # noqa: E402
from semnav_agents.learning.rllib.start import start_training  # noqa: E402
from semnav_agents.learning.rllib.weights import RLLIB_FILE  # noqa: E402
from semnav_env.networks.weights import load_tensors  # noqa: E402

TINY = replace(
    PRESETS["hallway"],
    name="tiny",
    max_seconds=3.0,
    envs=4,
    ppo=PPOSettings(hidden=(8,), rollout=32, batch_size=32, epochs=2),
)
TWO = RayOptions(runners=2)


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    return tmp_path_factory.mktemp("run")


@pytest.fixture(scope="module")
def trainer(folder):
    if (os.cpu_count() or 1) < 2:
        pytest.skip("two runners need two cores")
    trainer = start_training(TINY, folder, 0, TWO)
    yield trainer
    trainer.close()


def counts_of(trainer):
    """A list to which the decisions in each batch that the learner gets are added."""
    group, counts = trainer.algorithm.learner_group, []
    update = group.update

    def counted(*arguments, **options):
        counts.append(sum(len(episode) for episode in options["episodes"]))
        return update(*arguments, **options)

    group.update = counted
    return counts


def runners(trainer):
    """The process and the weights of each runner."""
    return trainer.algorithm.env_runner_group.foreach_env_runner(
        lambda runner: (os.getpid(), runner.module.get_state()), local_env_runner=False
    )


def listening_addresses(pid):
    """Addresses at which a process and its descendants listen, in hexadecimal digits."""
    parents = {
        int(path.parent.name): int(path.read_text().rpartition(")")[2].split()[1])
        for path in Path("/proc").glob("[0-9]*/stat")
    }
    family = {pid}
    while more := {child for child, parent in parents.items() if parent in family} - family:
        family |= more
    links = set()
    for descriptor in (fd for each in family for fd in Path(f"/proc/{each}/fd").iterdir()):
        with suppress(FileNotFoundError):  # closed meanwhile
            links.add(os.readlink(descriptor))
    rows = [
        row.split()
        for table in ("tcp", "tcp6")
        for row in Path(f"/proc/net/{table}").read_text().splitlines()[1:]
    ]
    return {
        row[1].partition(":")[0] for row in rows if row[3] == "0A" and f"socket:[{row[9]}]" in links
    }


def test_training_goes_on_when_a_machine_is_lost(tmp_path):
    """Two machines that are one; their cluster is joined by its address.

    It comes before all that need `trainer`, which has a Ray of its own.
    """
    from ray.cluster_utils import Cluster

    here = {"num_cpus": 1, "node_ip_address": "127.0.0.1"}
    cluster = Cluster(initialize_head=True, head_node_args=here)
    lost = cluster.add_node(**here)
    trainer = start_training(TINY, tmp_path, 0, RayOptions(address=cluster.address))
    learned = counts_of(trainer)
    trainer.advance()
    assert len(runners(trainer)) == 2
    cluster.remove_node(lost, allow_graceful=False)
    for _ in range(3):
        assert trainer.advance().steps == sum(learned)
    assert len(learned) == 4
    assert len(runners(trainer)) == 1
    trainer.close()
    cluster.shutdown()


def test_every_decision_is_counted_once(trainer):
    before, learned = trainer.steps, counts_of(trainer)
    reports = [trainer.advance() for _ in range(3)]
    assert reports[-1].steps == trainer.steps == before + sum(learned)
    assert all(count >= TWO.decisions(TINY) for count in learned)
    assert reports[-1].contact_free >= 0.0


@pytest.mark.skipif(not Path("/proc/net/tcp").exists(), reason="needs Linux")
def test_no_other_machine_can_reach_a_local_ray(trainer):
    loopback = {"0100007F", "0000000000000000FFFF00000100007F"}
    found = listening_addresses(os.getpid())
    assert found
    assert found <= loopback


def test_training_goes_on_when_a_runner_is_killed(trainer):
    """A second one starts in its place, with the weights of the learner; no decision is lost."""
    before, learned, (killed, _) = trainer.steps, counts_of(trainer), runners(trainer)[0]
    os.kill(killed, signal.SIGKILL)
    for _ in range(200):
        report = trainer.advance()
        found = runners(trainer)
        if len(found) == 2:
            break
    assert len(found) == 2
    assert killed not in {pid for pid, _ in found}
    assert report.steps == before + sum(learned)
    trainer.advance()
    expected = trainer._weights()
    for _, weights in runners(trainer):
        assert all(np.array_equal(weights[name], expected[name]) for name in weights)


def test_the_agent_acts_as_rllib_does(trainer, folder):
    trainer.advance()
    trainer.save()
    policy = LearnedAgent.load(folder).policy
    seen = np.random.default_rng(0).uniform(-1, 1, (20, COMPACT_SIZE)).astype(np.float32)
    import torch

    module = trainer.algorithm.get_module()
    with torch.no_grad():
        means = module.forward_inference({"obs": torch.from_numpy(seen)})["action_dist_inputs"]
    expected = np.clip(means[:, :2].numpy(), -1, 1)
    assert np.allclose([policy.act(row) for row in seen], expected, atol=1e-5)


def test_resuming_restores_weights_optimizer_and_count(trainer, folder):
    """It comes after all that need `trainer`, whose Ray it ends."""
    trainer.save()
    steps, kept = trainer.steps, load_tensors(folder / RLLIB_FILE)
    trainer.close()
    resumed = start_training(TINY, folder, 0, TWO, resume=True)
    assert resumed.steps == steps
    resumed.save()
    again = load_tensors(folder / RLLIB_FILE)
    assert kept.keys() == again.keys()
    assert all(np.array_equal(kept[name], again[name]) for name in kept)
    for _, weights in runners(resumed):
        assert all(np.array_equal(weights[name], kept[f"weights.{name}"]) for name in weights)
    assert resumed.advance().steps > steps
    resumed.close()
