"""Junctions of three veins: balance of forces and Murray's law, known and in general."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from reference.drawn_networks import honeycomb, junction
from reference.networks import network, random_planar

from vasc.analysis import find_sections
from vasc.analysis.junctions import balanced_angles, find_junctions, murray_exponents

seeds = st.integers(0, 2**32 - 1)
widths = st.floats(0.1, 10.0)


def of(net, width=None):
    return find_junctions(find_sections(net, width))


class TestBalance:
    @given(st.floats(0.0, 360.0), st.floats(1.0, 3.0), st.floats(0.5, 2.9))
    def test_forces_in_balance_leave_no_residual(self, turn, second, third):
        # a triangle of the three widths is closed by the forces
        if not abs(second - third) + 0.01 < 3.0 < second + third - 0.01:
            return
        w = np.array([3.0, second, third])
        forces = [np.array([3.0, 0.0])]
        x = (third**2 - 9.0 - second**2) / 6.0
        forces.append(np.array([x, np.sqrt(max(second**2 - x**2, 0.0))]))
        forces.append(-forces[0] - forces[1])
        angles = [np.degrees(np.arctan2(*force[::-1])) + turn for force in forces]
        net, _ = junction(angles, w)
        found = of(net, w)
        assert found.residuals == pytest.approx([0.0], abs=1e-7)
        assert found.widest_angles == pytest.approx(balanced_angles(found.widths), abs=1e-5)

    def test_limits(self):
        assert np.degrees(balanced_angles(np.array([[1.0, 1.0, 1.0]]))) == pytest.approx(120.0)
        # a thin side vein leaves a straight one
        thin = np.degrees(balanced_angles(np.array([[1.0, 1.0, 1e-6]])))
        assert thin == pytest.approx(180.0, abs=1e-3)

    def test_a_residual_by_hand(self):
        # 4 to the right, 2 up, 1 down: |(4, 1)| / 7
        net, w = junction([0, 90, 270], [4.0, 2.0, 1.0])
        assert of(net, w).residuals == pytest.approx(np.sqrt(17.0) / 7.0)
        assert np.degrees(of(net, w).widest_angles) == pytest.approx(90.0)

    def test_a_honeycomb_of_equal_veins_is_in_balance(self):
        found = of(honeycomb(4, 4))
        assert found.n_junctions > 20
        assert found.residuals == pytest.approx(0.0, abs=1e-9)
        assert found.shuffled_residuals() == pytest.approx(found.residuals, abs=1e-9)

    def test_shuffling_is_of_a_seed_and_makes_it_worse(self):
        rng = np.random.default_rng(1)
        nets = [junction([0.0, 171.0, 180.0 + 80.0], [6.0, 6.0, 1.0])[0] for _ in range(40)]
        points = np.concatenate([net.positions + 20.0 * k for k, net in enumerate(nets)])
        pairs = np.concatenate([net.segments + 4 * k for k, net in enumerate(nets)])
        w = np.tile([6.0, 6.0, 1.0], 40) * rng.uniform(0.99, 1.01, 120)
        found = of(network(points, pairs), w)
        assert (found.shuffled_residuals(1) == found.shuffled_residuals(1)).all()
        assert (found.shuffled_residuals(1) != found.shuffled_residuals(2)).any()
        assert np.median(found.shuffled_residuals()) > 2.0 * np.median(found.residuals)


class TestAgainstAPlainProgram:
    @given(seeds, st.floats(0.2, 0.9))
    def test_residuals_one_by_one(self, seed, share):
        rng = np.random.default_rng(seed)
        net = random_planar(rng, 30, share)
        w = rng.uniform(1.0, 9.0, net.n_segments)
        sections = find_sections(net, w)
        found = find_junctions(sections)
        expected = {}
        for node in np.flatnonzero(net.degrees == 3).tolist():
            force, total = np.zeros(2), 0.0
            for row in np.flatnonzero((net.segments == node).any(axis=1)).tolist():
                (section,) = sections.owners[sections.rows == row]
                side = int(sections.ends[section, 0] != node)
                vector = sections.leaving()[section, side]
                force += w[row] * vector / np.hypot(*vector)
                total += w[row]
            expected[node] = np.hypot(*force) / total
        # a ring that hangs on a node comes back to it: no three veins
        kept = {
            int(point): residual
            for point, residual in zip(found.points, found.residuals, strict=True)
        }
        assert kept.keys() <= expected.keys()
        assert kept == pytest.approx({node: expected[node] for node in kept})
        rings = sections.ends[sections.ends[:, 0] == sections.ends[:, 1], 0].tolist()
        assert expected.keys() - kept.keys() <= set(rings)

    @given(seeds, st.floats(0.0, 6.0), st.floats(0.01, 100.0))
    def test_turning_and_scaling_change_nothing(self, seed, angle, size):
        net = random_planar(np.random.default_rng(seed), 30, 0.6)
        w = np.random.default_rng(seed).uniform(1.0, 9.0, net.n_segments)
        turn = np.array([[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]])
        moved = network(size * net.positions @ turn.T, net.segments)
        assert of(moved, w * size).residuals == pytest.approx(of(net, w).residuals, abs=1e-6)


class TestMurray:
    @given(widths, widths, st.floats(0.5, 6.0))
    def test_the_exponent_that_made_the_widths(self, one, other, n):
        parent = (one**n + other**n) ** (1.0 / n)
        w = np.sort([[parent, one, other]])[:, ::-1]
        found = murray_exponents(w)
        if w[0, 1] < 0.98 * parent:
            assert found == pytest.approx(n, rel=1e-6)
        else:
            assert np.isnan(found).all()

    def test_none(self):
        assert murray_exponents(np.zeros((0, 3))).shape == (0,)


def test_four_veins_and_rings_are_no_junctions_of_three():
    four, _ = junction([0, 90, 180, 270], [1.0] * 4)
    assert of(four).n_junctions == 0
    ring = network([(0, 0), (1, 1), (1, -1), (-3, 0)], [(0, 1), (1, 2), (2, 0), (0, 3)])
    assert of(network(ring.positions, ring.segments, origins=[1] * 4)).n_junctions == 0


def test_without_junctions():
    found = of(network([], []))
    assert found.n_junctions == 0
    assert found.residuals.shape == found.shuffled_residuals().shape == (0,)
    assert found.long(1.0).n_junctions == 0
