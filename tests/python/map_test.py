"""Maps as arrays: levels without copies, lookups, shading, files."""

from pathlib import Path

import numpy as np
import pytest
import redmap
from conftest import directions, floats, two_paints, upper_directions


def test_levels_share_the_map_s_memory_and_keep_it() -> None:
    map = redmap.bake(redmap.sphere(), redmap.shader(two_paints), size=32)
    weights = map.weights(0)
    assert weights.shape == (32, 64, 2) and weights.dtype == np.uint8
    assert np.shares_memory(weights, map.coverage(0)) is False  # neighbours in one texel
    assert np.shares_memory(weights, map.weights(0))
    assert not weights.flags.writeable
    before = weights.copy()
    del map
    assert (weights == before).all()


def test_levels_halve_down_to_one_texel(noise_map: redmap.ReductionMap) -> None:
    shapes = [noise_map.weights(level).shape[:2] for level in range(noise_map.levels)]
    assert shapes[:3] == [(64, 128), (32, 64), (16, 32)] and shapes[-1] == (1, 1)
    with pytest.raises(redmap.Error, match="expected a level from 0 to"):
        noise_map.weights(noise_map.levels)


def test_lookup_of_a_wide_footprint_is_the_mean(noise_map: redmap.ReductionMap) -> None:
    whole = floats([[1, 0]]), floats([[0, 1]])
    coverage, weights = noise_map.lookup(floats([[0.5, 0.5]]), *whole)
    mean = noise_map.weights(0).mean((0, 1)) / 255 * np.array(noise_map.scales)
    assert coverage == pytest.approx([1])
    # The coarsest levels are bytes: half a step off at each of a few.
    assert weights[0] == pytest.approx(mean, abs=0.02)


def test_lookup_of_a_texel_is_the_texel(noise_map: redmap.ReductionMap) -> None:
    y, x = 20, 77
    uv = floats([[(x + 0.5) / 128, (y + 0.5) / 64]])
    _, weights = noise_map.lookup(uv, floats([[1e-5, 0]]), floats([[0, 1e-5]]))
    expected = noise_map.weights(0)[y, x] / 255 * np.array(noise_map.scales)
    assert weights[0] == pytest.approx(expected, abs=1e-3)


def test_map_shades_close_up_as_the_shader_does(noise_map: redmap.ReductionMap) -> None:
    count = 200
    shader, surface = redmap.shader("noise"), redmap.sphere()
    uv = np.random.default_rng(4).uniform(0.05, 0.95, (count, 2)).astype(np.float32)
    azimuth, polar = 2 * np.pi * uv[:, 0], np.pi * uv[:, 1]
    normal = np.stack([np.sin(polar) * np.cos(azimuth), np.cos(polar), np.sin(polar) * np.sin(azimuth)], 1)
    normal = normal.astype(np.float32)
    to_light, to_viewer = upper_directions(normal, 5), upper_directions(normal, 6)
    tiny = np.full((count, 2), 1e-6, np.float32)
    by_map = redmap.shade(surface, shader, noise_map, np.zeros(count, np.uint32), uv, tiny, -tiny[:, ::-1], to_light,
                          to_viewer)
    itself = shader.radiance(normal, normal, to_light, to_viewer)
    # Places differ by the rounding of sines: a few may lie across an edge of the pattern.
    assert (np.abs(by_map - itself).max(1) < 1e-3).mean() > 0.97


def test_saved_maps_load_as_they_were(noise_map: redmap.ReductionMap, tmp_path: Path) -> None:
    noise_map.save(tmp_path / "noise.exr")
    loaded = redmap.load_map(tmp_path / "noise.exr")
    assert loaded.shader == "noise" and loaded.verdict == noise_map.verdict
    assert loaded.parameters == noise_map.parameters
    for level in range(loaded.levels):
        assert (loaded.weights(level) == noise_map.weights(level)).all()
    with pytest.raises(redmap.Error, match="nowhere.exr"):
        redmap.load_map(tmp_path / "nowhere.exr")


def test_rows_that_do_not_fit_are_errors(noise_map: redmap.ReductionMap) -> None:
    uv = np.zeros((3, 2), np.float32)
    with pytest.raises(redmap.Error, match="duv_dy: expected 3 rows as in the first array, found 2"):
        noise_map.lookup(uv, uv, uv[:2])
    with pytest.raises(redmap.Error, match="uv: expected finite numbers, found another in row 1"):
        noise_map.lookup(floats([[0, 0], [np.inf, 0], [0, 0]]), uv, uv)
    with pytest.raises(TypeError):
        noise_map.lookup(directions(3, 1), uv, uv)  # type: ignore[arg-type, unused-ignore]
