"""MaterialX documents as shaders: known answers, the three forms that a material takes, and what is not supported."""

from pathlib import Path

import numpy as np
import pytest
import redmap
from conftest import ROOT, Rows, floats, upper_directions
from redmap import materialx

HEAD = '<?xml version="1.0"?>\n<materialx version="1.39" colorspace="lin_rec709">\n'
MATERIAL = """<surfacematerial name="Paint" type="material">
  <input name="surfaceshader" type="surfaceshader" nodename="surface" /></surfacematerial></materialx>"""
DULL = """<standard_surface name="surface" type="surfaceshader">
  <input name="base" type="float" value="1" /><input name="specular" type="float" value="0" />
  %s</standard_surface>"""


def document(folder: Path, body: str) -> str:
    file = folder / "paint.mtlx"
    file.write_text(HEAD + body + MATERIAL)
    return str(file)


def lambert(normals: Rows, to_light: Rows) -> Rows:
    return np.asarray(np.clip((normals * to_light).sum(1), 0, None) / np.pi, np.float32)


def test_dull_paint_is_lambert(tmp_path: Path) -> None:
    color = '<input name="base_color" type="color3" value="0.5, 1, 0.25" />'
    shader = redmap.shader(document(tmp_path, DULL % color))
    assert not shader.black_box and shader.summary == "Paint, a MaterialX material."
    normals = upper_directions(np.tile(floats([[0, 1, 0]]), (100, 1)), 1)
    to_light, to_viewer = upper_directions(normals, 2), upper_directions(normals, 3)
    found = shader.radiance(normals, normals, to_light, to_viewer)
    expected = lambert(normals, to_light)[:, None] * floats([0.5, 1, 0.25])
    assert np.abs(found - expected).max() < 1e-5


def test_one_of_several_materials_is_chosen_by_name(tmp_path: Path) -> None:
    color = '<input name="base_color" type="color3" value="%s" />'
    other = (DULL % color % "0, 1, 0").replace('"surface"', '"green"')
    second = """<surfacematerial name="Leaf" type="material">
  <input name="surfaceshader" type="surfaceshader" nodename="green" /></surfacematerial>"""
    file = document(tmp_path, DULL % color % "1, 0, 0" + other + second)
    straight = floats([[0, 0, 1]])
    for name, expected in (("Paint", [1, 0, 0]), ("Leaf", [0, 1, 0])):
        shader = redmap.shader(f"{file}#{name}")
        assert shader.summary == f"{name}, a MaterialX material."
        found = shader.radiance(straight, straight, straight, straight)
        assert np.abs(found - floats([expected]) / np.pi).max() < 1e-5
    with pytest.raises(redmap.Error, match="expected a material 'Bark', found"):
        redmap.shader(f"{file}#Bark")


def test_slopes_of_heights_turn_the_normal(tmp_path: Path) -> None:
    # MaterialX scales slopes over uv by 1/16: this height rises by one a unit of u.
    body = """<texcoord name="uv" type="vector2" />
      <multiply name="ramp" type="vector2"><input name="in1" type="vector2" nodename="uv" />
        <input name="in2" type="float" value="16" /></multiply>
      <extract name="height" type="float"><input name="in" type="vector2" nodename="ramp" />
        <input name="index" type="integer" value="0" /></extract>
      <heighttonormal name="slope" type="vector3"><input name="in" type="float" nodename="height" /></heighttonormal>
      <normalmap name="bump" type="vector3"><input name="in" type="vector3" nodename="slope" /></normalmap>"""
    normal_input = '<input name="normal" type="vector3" nodename="bump" />'
    shader = redmap.shader(document(tmp_path, body + DULL % (WHITE + normal_input)))
    place, normal, tangent = floats([[0, 0, 0]]), floats([[0, 0, 1]]), floats([[1, 0, 0]])
    against, along = floats([[-1, 0, 1]]) / np.sqrt(2), floats([[1, 0, 1]]) / np.sqrt(2)
    for to_light, cosine in ((against, 1), (normal, np.sqrt(0.5)), (along, 0)):
        found = shader.radiance(place, normal, np.asarray(to_light, np.float32), normal, tangent, floats([[0.3, 0.4]]))
        assert found[0] == pytest.approx([cosine / np.pi] * 3, abs=2e-3)


WHITE = '<input name="base_color" type="color3" value="1, 1, 1" />'


def test_pictures_are_found_beside_the_document_in_their_colours(tmp_path: Path) -> None:
    # Linear .5, 1, .25 as bytes of sRGB.
    redmap.write_image(tmp_path / "flat.png", np.tile(floats([0.5, 1, 0.25]), (4, 4, 1)))
    body = """<image name="flat" type="color3">
      <input name="file" type="filename" value="flat.png" colorspace="srgb_texture" /></image>"""
    shader = redmap.shader(document(tmp_path, body + DULL % '<input name="base_color" type="color3" nodename="flat" />'))
    up = floats([[0, 1, 0]])
    assert shader.radiance(up, up, up, up)[0] == pytest.approx(np.array([0.5, 1, 0.25]) / np.pi, abs=2e-3)


def test_emission_is_no_radiance(tmp_path: Path) -> None:
    glow = '<input name="emission" type="float" value="2" /><input name="emission_color" type="color3" value="1, 0, 0" />'
    shader = redmap.shader(document(tmp_path, DULL % (WHITE + glow)))
    up, below = floats([[0, 1, 0]]), floats([[0, -1, 0]])
    assert shader.radiance(up, up, below, up)[0] == pytest.approx([2, 0, 0], abs=1e-5)
    assert shader.radiance(up, up, up, up)[0] == pytest.approx(np.array([2, 0, 0]) + 1 / np.pi, abs=1e-5)


def test_mixtures_are_black_boxes(tmp_path: Path) -> None:
    body = """<oren_nayar_diffuse_bsdf name="one" type="BSDF"><input name="color" type="color3" value="1, 0, 0" />
        </oren_nayar_diffuse_bsdf>
      <oren_nayar_diffuse_bsdf name="other" type="BSDF"><input name="color" type="color3" value="0, 1, 0" />
        </oren_nayar_diffuse_bsdf>
      <mix name="both" type="BSDF"><input name="fg" type="BSDF" nodename="one" />
        <input name="bg" type="BSDF" nodename="other" /><input name="mix" type="float" value="0.25" /></mix>
      <surface name="surface" type="surfaceshader"><input name="bsdf" type="BSDF" nodename="both" /></surface>"""
    shader = redmap.shader(document(tmp_path, body))
    assert shader.black_box
    up = floats([[0, 1, 0]])
    assert shader.radiance(up, up, up, up)[0] == pytest.approx(np.array([0.25, 0.75, 0]) / np.pi, abs=1e-5)


def test_only_what_varies_is_stored() -> None:
    text, images = materialx.translate(str(ROOT / "docs" / "examples" / "stones.mtlx"))
    pattern = text.split("struct Pattern {")[1].split("}")[0].split()
    assert pattern == ["vec3", "in_base_color;", "float", "in_specular_roughness;"] and images == {}


@pytest.mark.parametrize(
    ("body", "complaint"),
    [
        ("<checkerboard", "paint.mtlx: "),
        (DULL % "" + '<surfacematerial name="Second" type="material" />', "expected one material, found Second, Paint: choose with paint.mtlx#NAME"),
        ('<geomcolor name="painted" type="color3" />' + DULL % '<input name="base_color" type="color3" nodename="painted" />',
         "expected positions, normals, tangents and the first uv of the surface, found 'color_0'"),
        ('<image name="wood" type="color3"><input name="file" type="filename" value="wood.png" /></image>'
         + DULL % '<input name="base_color" type="color3" nodename="wood" />',
         "node 'wood': expected a picture, found no file"),
    ],
)
def test_what_is_not_supported_is_one_line(tmp_path: Path, body: str, complaint: str) -> None:
    file = document(tmp_path, body)
    with pytest.raises(redmap.Error) as raised:
        redmap.shader(file)
    assert str(raised.value).startswith(file) and complaint in str(raised.value) and "\n" not in str(raised.value)


def test_a_python_without_materialx_is_an_error(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("REDMAP_PYTHON", "/nowhere/python")
    with pytest.raises(redmap.Error, match="expected the program /nowhere/python with MaterialX"):
        redmap.shader(document(tmp_path, DULL % ""))
