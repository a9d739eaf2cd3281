"""Scenes put together in Python: surfaces of arrays, pictures, comparison, verification."""

import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
import redmap
from conftest import ROOT, Rows, floats, indices, two_paints


def paper(places: redmap.Places, to_light: Rows, to_viewer: Rows) -> Rows:
    """White Lambert."""
    cosine = np.clip((places.normal * to_light).sum(1, keepdims=True), 0, None)
    return np.asarray(np.repeat(cosine / np.pi, 3, 1), np.float32)


def scene_of(surface: redmap.Surface, shader: redmap.Shader) -> redmap.Scene:
    camera = redmap.Camera(position=(0, 0, 4), width=48, height=40)
    light = redmap.Light.directional((0, 0, 1), (np.pi, np.pi, np.pi))
    return redmap.Scene([redmap.Object(surface, shader, "thing")], [light], camera)


QUAD = floats([[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]])
TRIANGLES = indices([[0, 1, 2], [0, 2, 3]])


def test_white_paper_that_faces_the_light_is_one() -> None:
    quad = redmap.mesh(QUAD, TRIANGLES, uv=(QUAD[:, :2] + np.float32(1)) / np.float32(2))
    assert quad.area == pytest.approx(4) and quad.uv_area == pytest.approx(1)
    shader = redmap.shader(paper)
    scene = scene_of(quad, shader)
    image = redmap.render(scene, [redmap.bake(quad, shader, size=16)])
    assert image.shape == (40, 48, 3) and image.dtype == np.float32
    assert image[20, 24] == pytest.approx([1, 1, 1], abs=0.01)
    assert image[0, 0] == pytest.approx([0, 0, 0])


def test_meshes_without_uv_get_some() -> None:
    assert 0 < redmap.mesh(QUAD, TRIANGLES).uv_area <= 1


def test_bad_meshes_are_errors() -> None:
    with pytest.raises(redmap.Error, match="triangles: expected vertices 0 to 3, found 4 in triangle 1"):
        redmap.mesh(QUAD, indices([[0, 1, 2], [0, 2, 4]]))
    with pytest.raises(redmap.Error, match="uv: expected 4 rows"):
        redmap.mesh(QUAD, TRIANGLES, uv=QUAD[:3, :2])
    with pytest.raises(redmap.Error, match="positions: expected finite numbers"):
        redmap.mesh(QUAD * np.float32(np.nan), TRIANGLES)


def test_map_and_supersampling_agree_and_the_map_is_verified() -> None:
    shader = redmap.shader(two_paints)
    scene = scene_of(redmap.sphere(), shader)
    map = redmap.bake(redmap.sphere(), shader, size=64)
    by_map = redmap.render(scene, [map])
    reference = redmap.render(scene, method="supersample", spp=64)
    result = redmap.compare(by_map, reference)
    assert result.rmse < 0.02 and result.worst[0].error >= result.rmse
    report = redmap.verify(scene.objects[0], map, pixels=30, spp=64, minifications=[4])
    assert report.certificate.rows[0].pixels > 0 and report.all.rms < 0.05


def test_objects_of_a_scene_change_in_place() -> None:
    scene = redmap.load_scene(ROOT / "scenes" / "sphere_noise.toml", ["camera.width=32", "camera.height=24"]).at(1)
    for object in scene.objects:
        object.transform.translate = (0, 0, 1000)  # behind the camera
    scene.objects.append(scene.objects[0])
    scene.background = (0.25, 0.5, 1)
    image = redmap.render(scene, method="original")
    assert (image == floats([0.25, 0.5, 1])).all()


def test_scenes_that_cannot_be_read_are_errors(tmp_path: Path) -> None:
    (tmp_path / "bad.toml").write_text("[camera]\nposition = [0, 0, 'far']\n")
    with pytest.raises(redmap.Error, match=r"bad.toml:2:\d+"):
        redmap.load_scene(tmp_path / "bad.toml")


def test_methods_and_maps_that_do_not_fit_are_errors() -> None:
    scene = scene_of(redmap.sphere(), redmap.shader(paper))
    with pytest.raises(redmap.Error, match='method: expected "map", "original" or "supersample", found "best"'):
        redmap.render(scene, method="best")
    with pytest.raises(redmap.Error, match="maps: expected one for each of 1 objects, found 0"):
        redmap.render(scene, [])


def test_pictures_are_written_and_read(tmp_path: Path) -> None:
    image = np.random.default_rng(7).uniform(size=(5, 7, 3)).astype(np.float32)
    redmap.write_image(tmp_path / "noise.exr", image)
    assert (redmap.read_image(tmp_path / "noise.exr") == image).all()


def test_program_of_the_readme_runs(tmp_path: Path) -> None:
    text = (ROOT / "README.md").read_text().split("```python\n")[1].split("```")[0]
    assert len(text.splitlines()) <= 10
    (tmp_path / "scenes").symlink_to(ROOT / "scenes")
    subprocess.run([sys.executable, "-c", text], check=True, cwd=tmp_path)
    assert redmap.read_image(tmp_path / "sphere.png").shape == (480, 640, 3)
