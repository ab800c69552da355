"""The reference implementations: against brute force, exact formulas, and the engine's models."""

from collections.abc import Callable, Iterator

import numpy as np
import pytest

import throng_sim as tg
from throng_sim import reference

Array = np.ndarray


def crowd(n: int, seed: int, gap: float = 0.05) -> tg.Scene:
    """Agents whose local model decides alone: no limits of bodies, no guard."""
    scene = tg.Scene(seed=seed)
    place = {"rectangle": {"center": [0, 0], "size": [1.2 * n**0.5] * 2, "gap": gap}}
    rules = {"preset": "animation", "guard": False, "acceleration": 1e6, "resolve": False}
    scene.group("all", n=n, place=place, goal={"opposite": {}}, speed=1.5, body={"radius": 0.2}, **rules)
    scene["time.sub_steps"] = 1
    return scene


def both(
    name: str, model: Callable[[tg.View], Array], scene: tg.Scene, steps: int
) -> Iterator[tuple[tg.View, Array, Array]]:
    """Yields views, and the velocities that the reference and the engine choose for them."""
    world = scene.build(model=name)
    for _ in range(steps):
        seen: list[tg.View] = []

        def ours(view: tg.View, seen: list[tg.View] = seen) -> Array:
            seen.append(view)
            return model(view)

        clone = world.clone()
        clone.set_model(tg.model(ours))
        clone.step()
        world.step()
        yield seen[0], clone.velocities.astype(float), world.velocities.astype(float)


def gaps(view: tg.View) -> Array:
    """Returns the least distance of centres less both radii, over the radii, of each agent."""
    near = view.near
    least = np.full(len(view), np.inf)
    np.minimum.at(least, near.row, np.linalg.norm(near.offsets.astype(float), axis=1) / near.radii - 1)
    return least


@pytest.mark.parametrize(("n", "seed"), [(2, 1), (2, 2), (6, 3), (12, 4), (40, 5), (40, 6)])
def test_orca_is_the_engine(n: int, seed: int) -> None:
    compared = 0
    for view, ours, theirs in both("orca", reference.orca, crowd(n, seed), 40):
        # where a gap is zero up to rounding, single precision may take it for an overlap
        clear = np.abs(gaps(view)) > 1e-5
        permitted = violations(view, ours) < 1e-6
        apart = np.abs(ours - theirs).max(axis=1)
        assert apart[clear & permitted].max(initial=0) < 1e-4
        # the least violation lies at crossings of lines, which may be nearly parallel
        assert apart[clear].max(initial=0) < 1e-3
        assert (violations(view, ours) < violations(view, theirs) + 1e-5)[clear].all()
        compared += (clear & permitted).sum()
    assert compared > 20 * n


def violations(view: tg.View, velocities: Array) -> Array:
    """Returns by how much each velocity violates the half-planes of the neighbours, m/s."""
    near = view.near
    own = view.velocities[near.row]
    points, normals = reference.half_plane(near.offsets, near.radii, own, near.velocities, 1.0, near.shares)
    most = np.zeros(len(view))
    np.maximum.at(most, near.row, ((points - velocities[near.row]) * normals).sum(axis=1))
    return most


def test_orca_keeps_to_its_horizon() -> None:
    def far(view: tg.View) -> Array:
        return reference.orca(view, time_horizon=3.0)

    for view, ours, theirs in both("orca:time_horizon=3", far, crowd(12, 7, gap=0.3), 20):
        clear = np.abs(gaps(view)) > 1e-5
        assert np.abs(ours - theirs)[clear].max(initial=0) < 1e-4


def test_vo_is_free_and_the_engine_is_nearer() -> None:
    """The engine finds the exact optimum, the reference the best of a grid: both are free, the engine's is nearer."""
    extra = []
    for seed in (1, 2, 3):
        for view, ours, theirs in both("vo", reference.vo, crowd(6, seed, gap=0.3), 40):
            clear = gaps(view) > 0.01
            free = seconds(view, ours, 1.0) > 2.0
            # the exact optimum is on the boundary: smaller bodies pass
            assert (seconds(view, theirs, 0.995) > 1.98)[free & clear].all()
            more = off(view, ours) - off(view, theirs)
            assert (more > -1e-4)[free & clear].all()
            extra.append(more[free & clear])
    extra_speed = np.concatenate(extra)
    assert len(extra_speed) > 300
    # velocities of the grid are 0.25 m/s apart
    assert np.median(extra_speed) < 0.12


def test_rvo_costs_little_more_than_the_engine() -> None:
    """Both minimise the same penalty over velocities that they try; the engine refines its grid about the best."""
    ratios = []
    for seed in (1, 2, 3):
        for view, ours, theirs in both("rvo", reference.rvo, crowd(6, seed, gap=0.3), 40):
            clear = gaps(view) > 0.01
            mine, engine = (reference.rvo_penalty(view, v[:, None])[clear, 0] for v in (ours, theirs))
            ratios.append((mine + 0.01) / (engine + 0.01))
    ratio = np.concatenate(ratios)
    assert len(ratio) > 300
    assert np.median(ratio) < 1.15
    assert (np.quantile(ratio, [0.05, 0.9]) > 0.9).all() and np.quantile(ratio, 0.9) < 3.0


def test_hrvo_agrees_on_the_side_with_the_engine() -> None:
    """Velocities differ by the grid; the cones are the same."""
    off_course = []
    for seed in (1, 2, 3):
        for view, ours, theirs in both("hrvo", reference.hrvo, crowd(4, seed, gap=0.5), 40):
            clear = gaps(view) > 0.01
            off_course.append(np.linalg.norm(ours - theirs, axis=1)[clear])
    assert np.median(np.concatenate(off_course)) < 0.15


def seconds(view: tg.View, velocities: Array, size: float) -> Array:
    """Returns the time to the first collision of each agent, by stepping through time."""
    near = view.near
    relative = velocities[near.row] - near.velocities
    times = np.arange(0.0, 2.001, 0.01)
    place = near.offsets[:, None] - relative[:, None] * times[:, None]
    touches = np.linalg.norm(place, axis=2) < size * near.radii[:, None]
    first = np.where(touches.any(axis=1), times[touches.argmax(axis=1)], np.inf)
    least = np.full(len(view), np.inf)
    np.minimum.at(least, near.row, first)
    return least


def off(view: tg.View, velocities: Array) -> Array:
    return np.asarray(np.linalg.norm(velocities - view.preferred, axis=1))


def test_time_to_collision_is_the_first_contact() -> None:
    rng = np.random.default_rng(1)
    times = np.linspace(0, 20, 20_001)
    for _ in range(200):
        offset, radius, velocity = rng.uniform(-4, 4, 2), rng.uniform(0.2, 1.5), rng.normal(0, 1, 2)
        touches = np.linalg.norm(offset - velocity * times[:, None], axis=1) <= radius
        found = reference.time_to_collision(offset, radius, velocity)
        if touches.any():
            assert found == pytest.approx(times[touches.argmax()], abs=2e-3)
        elif np.isfinite(found) and found < 20:
            # a graze, shorter than the steps
            assert np.abs(np.linalg.norm(offset - velocity * times[:, None], axis=1) - radius).min() < 1e-3
        for horizon in (0.5, 3.0):
            assert reference.in_truncated_cone(offset, radius, velocity, horizon) == (found <= horizon)
        assert reference.in_cone(offset, radius, velocity) == np.isfinite(found)


def test_time_to_wall_is_the_first_contact() -> None:
    rng = np.random.default_rng(2)
    times = np.linspace(0, 10, 5_001)
    for _ in range(200):
        a, b, velocity = rng.uniform(-4, 4, 2), rng.uniform(-4, 4, 2), rng.normal(0, 1, 2)
        along = np.clip(((velocity * times[:, None] - a) @ (b - a)) / ((b - a) @ (b - a)), 0, 1)
        distance = np.linalg.norm(a + along[:, None] * (b - a) - velocity * times[:, None], axis=1)
        if distance[0] > 0.31 and abs(distance.min() - 0.3) > 0.01:
            found = reference.time_to_wall(a, b, 0.3, velocity)
            first = times[(distance <= 0.3).argmax()] if (distance <= 0.3).any() else np.inf
            assert (found > 10 and first == np.inf) or found == pytest.approx(first, abs=3e-3)


def test_legs_touch_the_disc() -> None:
    rng = np.random.default_rng(3)
    offset = rng.uniform(-5, 5, (50, 2))
    radius = rng.uniform(0.1, 0.9, 50) * np.linalg.norm(offset, axis=1)
    for leg, side in zip(reference.legs(offset, radius), (1, -1), strict=True):
        assert np.linalg.norm(leg, axis=1) == pytest.approx(1)
        assert offset[:, 0] * leg[:, 1] - offset[:, 1] * leg[:, 0] == pytest.approx(side * radius)
        assert ((offset * leg).sum(axis=1) > 0).all()


def test_half_planes_take_the_nearest_way_out_of_the_cone() -> None:
    rng = np.random.default_rng(4)
    for _ in range(100):
        radius, horizon = rng.uniform(0.3, 1), rng.uniform(0.5, 3)
        offset = radius * rng.uniform(1.2, 5) * direction(rng.uniform(-np.pi, np.pi))
        velocity, other = rng.normal(0, 1, 2), rng.normal(0, 1, 2)
        relative = velocity - other
        point, normal = reference.half_plane(offset, radius, velocity, other, horizon)
        change = 2 * (point - velocity)
        # the changed relative velocity is on the boundary ...
        inside, outside = relative + change - 1e-6 * normal, relative + change + 1e-6 * normal
        assert reference.in_truncated_cone(offset, radius, inside, horizon)
        assert not reference.in_truncated_cone(offset, radius, outside, horizon)
        # ... and no smaller change leads there
        ring = relative + 0.999 * np.linalg.norm(change) * direction(np.linspace(0, 2 * np.pi, 720))
        now = reference.in_truncated_cone(offset, radius, relative, horizon)
        assert (reference.in_truncated_cone(offset, radius, ring, horizon) == now).all()


def direction(angle: float | Array) -> Array:
    return np.stack([np.cos(angle), np.sin(angle)], axis=-1)


def test_two_that_keep_to_their_half_planes_do_not_collide() -> None:
    rng = np.random.default_rng(5)
    for _ in range(200):
        radius, horizon = rng.uniform(0.3, 1), rng.uniform(0.5, 3)
        offset = radius * rng.uniform(1.2, 5) * direction(rng.uniform(-np.pi, np.pi))
        v, w = rng.normal(0, 1, (2, 2))
        chosen = []
        for x, own, other in ((offset, v, w), (-offset, w, v)):
            point, normal = reference.half_plane(x, radius, own, other, horizon)
            chosen.append(reference.linear_program([point], [normal], 9.0, rng.normal(0, 2, 2)))
        assert reference.time_to_collision(offset, radius - 1e-6, chosen[0] - chosen[1]) >= horizon - 1e-3


def test_without_a_permitted_velocity_the_greatest_violation_is_least() -> None:
    rng = np.random.default_rng(6)
    across = np.linspace(-1.5, 1.5, 121)
    grid = np.stack(np.meshgrid(across, across), axis=-1).reshape(-1, 2)
    grid = grid[np.linalg.norm(grid, axis=1) <= 1.5]
    tried = 0
    while tried < 60:
        count = int(rng.integers(3, 8))
        normals = direction(rng.uniform(-np.pi, np.pi, count))
        points = rng.normal(0, 0.8, (count, 2)) + 0.4 * normals
        violation = ((points - grid[:, None]) * normals).sum(axis=2).max(axis=1)
        if violation.min() > 0.05:
            tried += 1
            found = reference.linear_program(points, normals, 1.5, rng.normal(0, 1, 2))
            assert np.linalg.norm(found) <= 1.5 + 1e-6
            assert ((points - found) * normals).sum(axis=1).max() <= violation.min() + 1e-6


def test_hard_lines_are_kept() -> None:
    points, normals = [[0.5, 0.0], [1.0, 0.0], [0.0, 1.0]], [[-1.0, 0.0], [1.0, 0.0], [0.0, 1.0]]
    found = reference.linear_program(points, normals, 2.0, [0.0, 0.0], hard=1)
    assert found[0] <= 0.5 + 1e-9


def test_models_walk_round_a_ring_without_overlaps() -> None:
    angle = np.arange(8) * np.pi / 4
    at = 5 * direction(angle)
    for model in (reference.orca, reference.rvo, reference.vo, reference.hrvo):
        scene = tg.Scene(limit=60)
        scene.group("ring", at=at, goal=-at, preset="animation", body={"radius": 0.2}, acceleration=1000)
        summary = scene.build(model=model).run()
        assert summary.arrived == 8 and summary.overlaps == 0, model


def test_models_stay_in_their_room() -> None:
    room = {"rectangle": {"center": [0, 0], "size": [6, 6]}}
    for model in (reference.orca, reference.rvo, reference.vo, reference.boids):
        scene = tg.Scene({"walkable": room})
        scene.group("all", n=8, place={"walkable": {"gap": 0.3}}, goal={"opposite": {"center": [0, 0]}})
        world = scene.build(model=model)
        world.step(200)
        assert np.abs(world.positions).max() < 3.0, model
        assert world.summary.overlaps == 0


def test_a_pair_of_boids_pushes_oppositely() -> None:
    rng = np.random.default_rng(7)
    for _ in range(20):
        offset = rng.normal(0, 1, (1, 2))
        assert reference.separation(offset) == pytest.approx(-reference.separation(-offset))
    assert reference.flocking(np.empty((0, 2)), [1.0, 0.0], np.empty((0, 2))).tolist() == [0, 0]
    assert reference.separation([[0.0, 0.0]]).tolist() == [0, 0]
    offsets = rng.normal(0, 1, (7, 2))
    slow = -sum(x / (x @ x) for x in offsets)
    assert reference.separation(offsets) == pytest.approx(slow)
    assert reference.allocated([[3.0, 0.0], [0.0, 9.0], [5.0, 5.0]], 4.0) == pytest.approx([3, 1])


def test_boids_align() -> None:
    scene = tg.Scene(seed=2)
    place = {"disc": {"radius": 4, "gap": 0.5}}
    scene.group("birds", n=40, place=place, goal=(80, 0), preset="animation", speed=3.0, acceleration=1000)
    world = scene.build(model=tg.model(reach=3.0, neighbors=8)(reference.boids))
    world.step(150)
    heading = world.velocities / np.linalg.norm(world.velocities, axis=1, keepdims=True)
    assert np.linalg.norm(heading.mean(axis=0)) > 0.9
    assert world.summary.overlaps == 0


def test_seek_flee_and_arrive() -> None:
    rng = np.random.default_rng(8)
    at, target = rng.uniform(-5, 5, (30, 2)), rng.uniform(-5, 5, 2)
    wanted = reference.seek(at, target, 2.0)
    assert np.linalg.norm(wanted, axis=1) == pytest.approx(2)
    time = np.linalg.norm(target - at, axis=1) / 2
    assert at + wanted * time[:, None] == pytest.approx(np.broadcast_to(target, at.shape))
    assert reference.flee(at, target, 2.0) == pytest.approx(-wanted)
    slow = reference.arrive(at, target, 2.0, 3.0)
    distance = np.linalg.norm(target - at, axis=1)
    assert np.linalg.norm(slow, axis=1) == pytest.approx(2 * np.minimum(distance / 3, 1))
    # agents that arrive come to rest at the target
    for _ in range(400):
        at = at + 0.04 * reference.arrive(at, target, 2.0, 3.0)
    assert at == pytest.approx(np.broadcast_to(target, at.shape), abs=1e-3)
    assert reference.seek([target], target, 2.0).tolist() == [[0, 0]]


def test_a_pursuer_catches_sooner_than_a_seeker() -> None:
    caught = {}
    for name in ("seek", "pursue"):
        at, quarry, velocity = np.array([[0.0, 0.0]]), np.array([10.0, 0.0]), np.array([0.0, 1.0])
        caught[name] = 0
        while np.linalg.norm(at[0] - quarry) > 0.3 and caught[name] < 2000:
            caught[name] += 1
            if name == "seek":
                wanted = reference.seek(at, quarry, 1.5)
            else:
                wanted = reference.pursue(at, quarry, velocity, 1.5, most=9.0)
            at, quarry = at + 0.02 * wanted, quarry + 0.02 * velocity
    assert caught["pursue"] < 0.9 * caught["seek"]


def test_wanderers_turn_by_at_most_45_degrees() -> None:
    rng = np.random.default_rng(9)
    heading, turns = rng.uniform(-np.pi, np.pi, 100), rng.uniform(-np.pi, np.pi, 100)
    for _ in range(50):
        wanted, turns = reference.wander(heading, turns, 1.3, 0.4, rng)
        assert np.linalg.norm(wanted, axis=1) == pytest.approx(1.3)
        assert ((wanted * direction(heading)).sum(axis=1) >= 1.3 * np.cos(np.pi / 4) - 1e-9).all()
        heading = np.arctan2(wanted[:, 1], wanted[:, 0])


def test_agents_follow_a_path() -> None:
    path = np.array([[0.0, 0.0], [10.0, 0.0], [10.0, 10.0]])
    at, velocity = np.array([[0.0, 2.0], [1.0, -1.5]]), np.zeros((2, 2))
    far = []
    for _ in range(400):
        velocity = reference.follow_path(at, velocity, path, 0.5, 1.3)
        at = at + 0.04 * velocity
        far.append(reference.nearest_on_path(at, path)[1].max())
    assert max(far[100:]) < 1.0
    assert np.linalg.norm(at - path[-1], axis=1).max() < 1.5


def test_steering_is_limited() -> None:
    velocity, wanted = np.array([[1.0, 0.0]]), np.array([[-1.0, 0.0]])
    assert reference.steered(velocity, wanted, 0.5, 0.1) == pytest.approx(np.array([[0.95, 0.0]]))
    assert reference.steered(velocity, wanted, 9.0, 1.0) == pytest.approx(wanted)


@pytest.mark.parametrize("reach", [None, 6.0])
def test_the_field_is_that_of_the_engine(reach: float | None) -> None:
    rng = np.random.default_rng(10)
    corners = np.array([(-7.0, -7.0), (-7.0, 7.0), (7.0, -7.0), (7.0, 7.0)])
    anchors, velocities = np.concatenate([corners, rng.uniform(-5, 5, (9, 2))]), rng.normal(0, 0.5, (13, 2))
    # between the anchors: beyond them, fields of scenes fade
    at = rng.uniform(-5, 5, (60, 2)).round(3)
    # scenes sample sketches on a grid
    sketch = {"cell": 0.02, "anchors": [{"at": a, "velocity": v} for a, v in zip(anchors, velocities, strict=True)]}
    if reach is not None:
        sketch["kernel"] = {"wendland": {"reach": reach}}
    scene = tg.Scene(field=[{"name": "drawn", "flow": {"sketch": sketch}}])
    rules = {"preset": "animation", "guard": False, "acceleration": 1e6, "resolve": False, "keep_right": 0}
    scene.group("all", at=at, field={"of": {"named": "drawn"}}, speed=9.0, model="none", body={"radius": 0.01}, **rules)
    # a step so short that agents hardly leave their places
    scene["time.step"] = 1e-5
    world = scene.build()
    world.step()
    apart = np.abs(world.velocities - reference.rbf(anchors, velocities, reach=reach)(at))
    assert apart.max() < 5e-3 and np.median(apart) < 1e-4


def test_fields_go_through_their_anchors() -> None:
    rng = np.random.default_rng(11)
    for count in (1, 2, 3, 10):
        anchors, velocities = rng.uniform(-50, 50, (count, 2)), rng.normal(0, 1, (count, 2))
        for reach in (None, 30.0):
            assert reference.rbf(anchors, velocities, reach=reach)(anchors) == pytest.approx(velocities, abs=1e-9)
    slope = rng.normal(0, 1, (2, 2))
    places = rng.uniform(-60, 60, (20, 2))
    assert reference.rbf(anchors, anchors @ slope)(places) == pytest.approx(places @ slope, abs=1e-8)
    on_a_line = np.array([[0.0, 0.0], [1.0, 1.0], [2.0, 2.0]])
    field = reference.rbf(on_a_line, [[1.0, 0.0], [2.0, 0.0], [3.0, 0.0]])
    assert field([[1.0, -1.0]]) == pytest.approx(field([[-1.0, 1.0]]))
    smooth = reference.rbf(anchors, velocities, smoothing=0.1)(anchors)
    assert 0.01 < np.abs(smooth - velocities).max() < 3
    with pytest.raises(ValueError, match=r"must both have the shape \(k, 2\)"):
        reference.rbf(anchors, velocities[:-1])


def test_curl_noise_has_no_divergence_and_the_given_speed() -> None:
    rng = np.random.default_rng(12)
    at = rng.uniform(-40, 40, (4000, 2))
    speed = np.sqrt(
        np.mean([(reference.curl_noise(at, speed=0.7, seed=seed) ** 2).sum(axis=1).mean() for seed in range(20)])
    )
    assert speed == pytest.approx(0.7, rel=0.05)

    def disc(places: Array) -> tuple[Array, Array]:
        far = np.linalg.norm(places, axis=1)
        return far - 1.0, places / far[:, None]

    step = 1e-5
    for wall in (None, disc):
        at = direction(rng.uniform(0, 2 * np.pi, 200)) * rng.uniform(1, 4, (200, 1))

        def field(places: Array, wall: Callable[[Array], tuple[Array, Array]] | None = wall) -> Array:
            return reference.curl_noise(places, 0.3, length=0.8, seed=5, wall=wall)

        slope = [(field(at + step * axis) - field(at - step * axis)) / (2 * step) for axis in np.eye(2)]
        assert np.abs(slope[0][:, 0] + slope[1][:, 1]).max() < 1e-6 * np.abs(slope).max()
    on_wall = direction(rng.uniform(0, 2 * np.pi, 100))
    assert np.abs((field(on_wall) * on_wall).sum(axis=1)).max() < 1e-9
    early, late = (reference.curl_noise(at, time, period=0.5, seed=1) for time in (0.0, 3.0))
    assert abs((early * late).sum()) < 0.3 * (early**2).sum()
