"""Baking from Python: the same maps as the program's, black boxes, progress, interruption, errors."""

import os
import signal
import subprocess
import threading
import time
from pathlib import Path

import numpy as np
import pytest
import redmap
from conftest import ROOT, Rows, floats, two_paints, upper_directions

SCENE = ROOT / "scenes" / "sphere_noise.toml"


def test_map_is_the_program_s_byte_for_byte(tmp_path: Path) -> None:
    program = os.environ["REDMAP_PROGRAM"]  # as scripts/check_python.sh says it
    subprocess.run([program, "bake", SCENE, "--size", "64", "-o", tmp_path / "program"], check=True)
    ball = redmap.load_scene(SCENE).at(1).objects[0]
    redmap.bake(ball.surface, ball.shader, size=64).save(tmp_path / "python.exr")
    assert (tmp_path / "python.exr").read_bytes() == (tmp_path / "program" / ball.map_path.name).read_bytes()


def test_map_is_the_same_for_any_number_of_threads(tmp_path: Path) -> None:
    for threads in (1, 2):
        with redmap.ThreadLimit(threads):
            assert redmap.thread_count() == threads
            redmap.bake(redmap.sphere(), redmap.shader(two_paints), size=32).save(tmp_path / f"{threads}.exr")
    assert (tmp_path / "1.exr").read_bytes() == (tmp_path / "2.exr").read_bytes()


def test_two_paints_are_two_basis_reflectances() -> None:
    map = redmap.bake(redmap.sphere(), redmap.shader(two_paints), size=64, progress=None)
    assert len(map.basis) == 2
    # v runs from the top, u all around: the upper half is one paint, the lower the other.
    weights = map.weights(0).astype(np.float32) / 255 * np.array(map.scales, np.float32)
    upper, lower = weights[:31].mean((0, 1)), weights[33:].mean((0, 1))
    assert sorted(upper.round(2)) == [0, 1] and sorted(lower.round(2)) == [0, 1]
    assert upper.argmax() != lower.argmax()


def test_function_and_text_of_one_reflectance_agree() -> None:
    def velvet(places: redmap.Places, to_light: Rows, to_viewer: Rows) -> Rows:
        light, viewer = (places.normal * to_light).sum(1), (places.normal * to_viewer).sum(1)
        half = to_light + to_viewer
        half /= np.linalg.norm(half, axis=1, keepdims=True)
        shine = np.clip((half * places.normal).sum(1), 0, None) ** 40
        is_satin = (places.position[:, 1] * 12) % 1 < 0.4
        rim = (1 - viewer) ** 4 + (1 - light) ** 4
        cloth = np.array([0.5, 0.02, 0.08])
        satin = cloth / np.pi + 0.4 * shine[:, None]
        pile = cloth * (0.3 / np.pi + 0.5 * rim[:, None])
        lit = np.where((light > 0) & (viewer > 0), light, 0)[:, None]
        return np.asarray(np.where(is_satin[:, None], satin, pile) * lit, np.float32)

    text = redmap.shader(str(ROOT / "docs" / "examples" / "velvet.glsl"))
    normals = upper_directions(np.tile(floats([[0, 1, 0]]), (500, 1)), 1)
    places = (normals, normals, upper_directions(normals, 2), upper_directions(normals, 3))
    assert np.abs(redmap.shader(velvet).radiance(*places) - text.radiance(*places)).max() < 1e-4


def test_progress_rises_to_one() -> None:
    parts: list[float] = []
    redmap.bake(redmap.sphere(), redmap.shader("marble"), size=512, progress=parts.append)
    assert parts == sorted(parts) and parts[-1] == 1


def test_what_progress_raises_stops_the_bake() -> None:
    def stop(part: float) -> None:
        raise LookupError("enough")

    started = time.monotonic()
    with pytest.raises(LookupError, match="enough"):
        redmap.bake(redmap.sphere(), redmap.shader("marble"), size=8192, progress=stop)
    assert time.monotonic() - started < 5


def test_interrupt_stops_the_bake() -> None:
    # Where a shell started the tests in the background, Ctrl-C is ignored until somebody asks for it.
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    timer = threading.Timer(0.3, lambda: os.kill(os.getpid(), signal.SIGINT))
    timer.start()
    started = time.monotonic()
    with pytest.raises(KeyboardInterrupt):
        redmap.bake(redmap.sphere(), redmap.shader("marble"), size=8192)
    timer.join()
    signal.signal(signal.SIGINT, before)
    assert time.monotonic() - started < 5


def test_what_a_function_raises_comes_out_of_the_bake() -> None:
    def broken(places: redmap.Places, to_light: Rows, to_viewer: Rows) -> Rows:
        raise ZeroDivisionError("in the shader")

    with pytest.raises(ZeroDivisionError, match="in the shader"):
        redmap.bake(redmap.sphere(), redmap.shader(broken), size=32)


def test_answers_that_are_no_radiance_are_errors() -> None:
    surface = redmap.sphere()
    with pytest.raises(redmap.Error, match=r'"flat": expected an array of shape \(\d+, 3\), found \(3,\)'):
        redmap.bake(surface, redmap.shader(lambda p, l, v: np.zeros(3, np.float32), "flat"), size=32)
    with pytest.raises(redmap.Error, match='"nothing": expected finite numbers, found nan at position'):
        redmap.bake(surface, redmap.shader(lambda p, l, v: l * np.float32(np.nan), "nothing"), size=32)


def test_errors_are_the_library_s_own_line() -> None:
    with pytest.raises(redmap.Error, match="^there is no library shader 'noize'; did you mean 'noise'\\?$"):
        redmap.shader("noize")
    with pytest.raises(redmap.Error, match='selection: expected "greedy" or "paper"'):
        redmap.bake(redmap.sphere(), redmap.shader("noise"), selection="best")


def test_options_are_explained_by_their_comments() -> None:
    assert "most basis reflectances, 1 to kMaxBasis" in str(redmap.bake.__doc__)
    comment = "Bakes `shader` on `surface`. The result is the same for any number of threads."
    assert comment in str(redmap.bake.__doc__)
    assert "/// " + comment in (ROOT / "src" / "bake" / "bake.h").read_text()
