"""Exported materials in Cycles beside Cycles' own procedural checker: interior RMSE against 2048 samples of the procedural.

usage: python compare.py GLTF_FOLDER TX_FOLDER MINIFICATION PICTURES
"""
import pathlib
import sys

import bpy
import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent))
# Blender as a module leaves its own packages out, among them that which asks OSL shaders for their inputs.
sys.path += map(str, pathlib.Path(bpy.__file__).parents[3].glob("python/lib/python*/site-packages"))
from blender_import import Nodes, import_map, make_material, set_samples  # noqa: E402

SCALE, OFFSET = 9, (100.37, 100.21, 100.11)  # of checker.glsl
PIXEL = 2 * np.tan(np.radians(20)) / 512  # at a distance of 1


def procedural():
    """checker.glsl in Cycles' own nodes."""
    material = bpy.data.materials.new("procedural")
    material.use_nodes = True
    nodes = Nodes(material.node_tree, None)
    place = nodes.new("ShaderNodeTexCoord").outputs["Object"]
    # glTF's y is Blender's z.
    place = nodes.new("ShaderNodeMapping", Vector=place, Location=OFFSET, Rotation=(-np.pi / 2, 0, 0), Scale=(SCALE,) * 3)
    is_copper = nodes.new("ShaderNodeTexChecker", Vector=place.outputs[0], Scale=1).outputs["Fac"]
    copper = copper_of(nodes)
    paint = nodes.principled(None, Base_Color=(0.05, 0.2, 0.4, 1), Metallic=0, Roughness=0.6)
    mixed = nodes.new("ShaderNodeMixShader", {0: is_copper, 1: paint, 2: copper})
    nodes.new("ShaderNodeOutputMaterial", Surface=mixed.outputs[0])
    return material


def copper_of(nodes):
    return nodes.principled(None, Base_Color=(0.75, 0.38, 0.22, 1), Metallic=1, Roughness=0.35)


def copper_alone():
    """No texture at all: what the samples of a pixel see of the shape is left."""
    material = bpy.data.materials.new("copper")
    material.use_nodes = True
    nodes = Nodes(material.node_tree, None)
    nodes.new("ShaderNodeOutputMaterial", Surface=copper_of(nodes))
    return material


def texel_width(thing, size):
    """Median over the triangles."""
    mesh = thing.data
    uv = np.empty(2 * len(mesh.loops), np.float32)
    mesh.uv_layers.active.data.foreach_get("uv", uv)
    uv = uv.reshape(-1, 3, 2)
    edges = uv[:, 1:] - uv[:, :1]
    area_uv = 0.5 * np.abs(edges[:, 0, 0] * edges[:, 1, 1] - edges[:, 0, 1] * edges[:, 1, 0])
    area = np.array([face.area for face in mesh.polygons])
    return np.median(np.sqrt(area / np.maximum(area_uv, 1e-12))) / size


def set_scene(thing, distance):
    scene = bpy.context.scene
    corners = np.array([thing.matrix_world @ v.co for v in thing.data.vertices])
    centre, radius = 0.5 * (corners.min(0) + corners.max(0)), 0.5 * np.linalg.norm(corners.max(0) - corners.min(0))
    sun = bpy.data.objects.new("sun", bpy.data.lights.new("sun", "SUN"))
    sun.data.energy, sun.data.angle, sun.rotation_euler = 3, 0, (0.9, 0, 0.5)
    camera = bpy.data.objects.new("camera", bpy.data.cameras.new("camera"))
    camera.location, camera.rotation_euler = centre - np.array([0, distance, 0]), (np.pi / 2, 0, 0)
    pixels = int(np.ceil(2.1 * radius / distance / PIXEL))
    camera.data.angle = 2 * np.arctan(0.5 * pixels * PIXEL)
    for new in (sun, camera):
        scene.collection.objects.link(new)
    scene.camera = camera
    scene.render.resolution_x = scene.render.resolution_y = pixels
    scene.render.film_transparent = True
    cycles = scene.cycles
    cycles.device, cycles.use_adaptive_sampling, cycles.use_denoising = "CPU", False, False
    cycles.max_bounces, cycles.pixel_filter_type = 0, "BOX"
    scene.render.filter_size = cycles.filter_width = 1
    scene.render.image_settings.file_format, scene.render.image_settings.color_depth = "OPEN_EXR", "32"


def render(path, samples, seed):
    scene = bpy.context.scene
    set_samples(samples)
    scene.cycles.seed, scene.render.filepath = seed, str(path)
    bpy.ops.render.render(write_still=True)
    picture = bpy.data.images.load(str(path))
    picture.colorspace_settings.name = "Non-Color"
    pixels = np.empty(4 * picture.size[0] * picture.size[1], np.float32)
    picture.pixels.foreach_get(pixels)
    return pixels.reshape(picture.size[1], picture.size[0], 4)


def main():
    gltf, tx, minification, pictures = sys.argv[1:5]
    pictures = pathlib.Path(pictures).resolve()
    bpy.ops.wm.read_factory_settings(use_empty=True)
    bpy.context.scene.render.engine = "CYCLES"
    thing = import_map(gltf, tx, "k")
    thing.data.materials.append(procedural())
    thing.data.materials.append(make_material(pathlib.Path(tx).resolve(), "one"))
    thing.data.materials.append(copper_alone())
    set_scene(thing, float(minification) * texel_width(thing, 512) / PIXEL)

    def picture(name, slot, samples, seed):
        thing.data.polygons.foreach_set("material_index", np.full(len(thing.data.polygons), slot, np.int32))
        thing.data.update()
        return render(pictures / f"{name}.exr", samples, seed)

    reference = picture("reference", 1, 2048, 1)
    whole = reference[..., 3] > 0.9999
    inside = whole.copy()
    for y in (-1, 0, 1):
        for x in (-1, 0, 1):
            inside &= np.roll(whole, (y, x), (0, 1))

    def report(name, found, true=reference):
        error = np.sqrt(np.mean((found - true)[inside][:, :3] ** 2))
        print(f"{name:32} {error:.4f}")

    print(f"{inside.sum()} pixels inside of {reference.shape[1]} x {reference.shape[0]}, mean {reference[inside][:, :3].mean():.4f}")
    for samples in (4, 16, 64):
        report(f"procedural, {samples} samples", picture(f"procedural{samples}", 1, samples, 2))
    for samples in (4, 16, 64):
        report(f"k materials, {samples} samples", picture(f"k{samples}", 0, samples, 2))
        report(f"one material, {samples} samples", picture(f"one{samples}", 2, samples, 2))
    report("reference, another 2048 samples", picture("again", 1, 2048, 3))
    report("copper alone, 4 samples", picture("copper4", 3, 4, 2), picture("copper", 3, 2048, 1))


if __name__ == "__main__":
    main()
