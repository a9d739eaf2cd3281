"""What `redmap export` wrote, in Blender: the mesh of `--to gltf`, and a material for Cycles with the textures of `--to tx`.

    blender --background --python blender_import.py -- bunny/gltf bunny/tx bunny.blend [one]

or, in a script of your own, `import_map()`. The material is the k fitted ones with their masks, or the averaged one.
Textures are read by a small OSL shader, since only that way Cycles filters them over the footprint of a ray: the scene has to be
rendered on the CPU, with Open Shading Language on, which import_map() sees to. set_samples() is to be called after all imports.
"""
import json
import pathlib
import sys

import bpy

TEXTURE_SHADER = pathlib.Path(__file__).resolve().parent / "cycles" / "redmap_texture.osl"


def import_map(gltf_folder, tx_folder, kind="k"):
    """Adds the object with its material to the scene and returns it. `kind`: "k" fitted materials or "one" averaged."""
    gltf_folder, tx_folder = pathlib.Path(gltf_folder).resolve(), pathlib.Path(tx_folder).resolve()
    document = gltf_folder / json.loads((gltf_folder / "manifest.json").read_text())["gltf"]
    bpy.ops.import_scene.gltf(filepath=str(document))
    thing = bpy.context.selected_objects[0]
    bpy.context.scene.cycles.shading_system = True
    thing.data.materials.clear()
    thing.data.materials.append(make_material(tx_folder, kind))
    return thing


def set_samples(samples):
    """Renders with that many samples a pixel, each of which looks textures up over its own part of it."""
    bpy.context.scene.cycles.samples = samples
    for material in bpy.data.materials:
        for node in material.node_tree.nodes:
            if node.bl_idname == "ShaderNodeScript" and "width" in node.inputs:
                node.inputs["width"].default_value = samples ** -0.5


def make_material(tx_folder, kind):
    manifest = json.loads((tx_folder / "manifest.json").read_text())
    material = bpy.data.materials.new(f"{manifest['name']} {kind}")
    material.use_nodes = True
    nodes = Nodes(material.node_tree, tx_folder)
    normal = None
    if "normal" in manifest["one_material"]:
        normal = nodes.new("ShaderNodeNormalMap", Color=nodes.texture(manifest["one_material"]["normal"])[0]).outputs[0]
    if kind == "k":
        surface = None
        for fitted, mask in zip(manifest["materials"], manifest["masks"]):
            part = nodes.scaled(nodes.fitted(fitted, normal), nodes.texture(mask["file"])[1], mask["scale"])
            surface = nodes.new("ShaderNodeAddShader", {0: surface, 1: part}).outputs[0] if surface else part
    else:
        surface = nodes.averaged(manifest["one_material"], normal)
    nodes.new("ShaderNodeOutputMaterial", Surface=surface)
    return material


class Nodes:
    """A node tree that is added to; inputs are values, or outputs of nodes."""

    def __init__(self, tree, folder):
        self.tree, self.folder = tree, folder
        tree.nodes.clear()
        self.uv = self.new("ShaderNodeUVMap").outputs[0]

    def new(self, kind, numbered=None, **named):
        node = self.tree.nodes.new(kind)
        for name, value in {**(numbered or {}), **named}.items():
            socket = node.inputs[name if isinstance(name, int) else name.replace("_", " ")]
            if isinstance(value, bpy.types.NodeSocket):
                self.tree.links.new(value, socket)
            elif value is not None:
                socket.default_value = value
        return node

    def texture(self, file, is_color=False):
        """The texel as a colour, and its first channel."""
        node = self.tree.nodes.new("ShaderNodeScript")
        node.mode, node.filepath = "EXTERNAL", str(TEXTURE_SHADER)
        node.update()
        node.inputs["file"].default_value = str(self.folder / file)
        node.inputs["is_color"].default_value = int(is_color)
        self.tree.links.new(self.uv, node.inputs["uv"])
        return node.outputs["texel"], node.outputs["value"]

    def scaled(self, shader, weight, scale):
        """Cycles mixes by 0 to 1: a scale above 1, a brighter copy of a reflectance, is cut there."""
        part = self.new("ShaderNodeMath", {0: weight, 1: scale})
        part.operation = "MULTIPLY"
        return self.new("ShaderNodeMixShader", {0: part.outputs[0], 2: shader}).outputs[0]

    def principled(self, normal, **inputs):
        node = self.new("ShaderNodeBsdfPrincipled", Normal=normal, IOR=1.5, **inputs)
        node.distribution = "GGX"
        return node.outputs[0]

    def fitted(self, m, normal):
        along = m["roughness"] ** 2 + (1 - m["roughness"] ** 2) * m["anisotropy"] ** 2
        across = m["roughness"] ** 2
        # Cycles divides and multiplies squared roughness by sqrt(1 - .9 anisotropy).
        return self.principled(
            normal, Base_Color=(*m["base_color"], 1), Metallic=m["metallic"], Roughness=(along * across) ** 0.25,
            Anisotropic=min(1, (1 - across / along) / 0.9), Anisotropic_Rotation=m["anisotropy_rotation"] / 6.2831853,
            Specular_Tint=(*(m["specular"] * c for c in m["specular_color"]), 1), Transmission_Weight=m["transmission"],
            Coat_Weight=m["coat"], Coat_Roughness=m["coat_roughness"], Emission_Color=(*m["emission"], 1),
            Emission_Strength=1)

    def averaged(self, one, normal):
        rough = self.new("ShaderNodeSeparateColor", Color=self.texture(one["metallic_roughness"])[0])
        inputs = {}
        if "emission" in one:
            inputs = {"Emission_Color": self.texture(one["emission"], True)[0], "Emission_Strength": one["emission_scale"]}
        if "transmission" in one:
            inputs["Transmission_Weight"] = self.texture(one["transmission"])[1]
        return self.principled(normal, Base_Color=self.texture(one["base_color"], True)[0], Roughness=rough.outputs[1],
                               Metallic=rough.outputs[2], Specular_IOR_Level=0.5 * one["specular"], **inputs)


if __name__ == "__main__":
    arguments = sys.argv[sys.argv.index("--") + 1:] if "--" in sys.argv else sys.argv[1:]
    if len(arguments) not in (3, 4):
        sys.exit("expected the folders of --to gltf and --to tx, and a .blend file to write, found " + " ".join(arguments))
    bpy.ops.wm.read_factory_settings(use_empty=True)
    bpy.context.scene.render.engine = "CYCLES"
    import_map(*arguments[:2], *arguments[3:])
    set_samples(16)
    bpy.ops.wm.save_as_mainfile(filepath=str(pathlib.Path(arguments[2]).resolve()))
