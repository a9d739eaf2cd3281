"""A MaterialX document becomes one of redmap's shaders: GLSL by MaterialX's own generator, put into the contract of
docs/bring_your_shader.md.

usage: materialx.py FILE[#MATERIAL]

Prints JSON: {"text": the shader, "images": {sampler: file}}, or {"error": one line}. The library runs this text with
`python3 -c`, so that the program needs no Python of its own.

The generator writes `main()`: first what the nodes compute, then one call of the surface shader with it. What is before
the call becomes `pattern()`, the call becomes `radiance()`, and arguments that vary over the surface become the members
of `Pattern`. Materials of another form, such as mixtures of surface shaders, become black boxes: `main()` as a whole."""

import json
import os
import re
import sys

# What a Surface is to MaterialX. World and object are the same: maps are baked at rest.
VERTEX_DATA = {
    r"position(Object|World)": "at.position * p.scale",
    r"normal(Object|World)": "at.normal",
    r"tangent(Object|World)": "at.tangent",
    r"bitangent(Object|World)": "cross(at.normal, at.tangent)",
    r"texcoord_0": "at.uv * p.scale",
}
# The same in the shading frame, where radiance() is asked.
SHADING_FRAME = {
    r"position(Object|World)": "vec3(0.0)",
    r"normal(Object|World)": "vec3(0.0, 0.0, 1.0)",
    r"tangent(Object|World)": "vec3(1.0, 0.0, 0.0)",
    r"bitangent(Object|World)": "vec3(0.0, 1.0, 0.0)",
    r"texcoord_0": "vec2(0.0)",
}
NORMAL, TANGENT = "vec3(0.0, 0.0, 1.0)", "vec3(1.0, 0.0, 0.0)"

# In place of what the generator takes from a renderer.
RENDERER = """
vec3 mtlx_to_light;
vec3 mtlx_irradiance;
"""
LIGHT = """void sampleLightSource(LightData light, vec3 position, out lightshader result)
{
    result.intensity = mtlx_irradiance;
    result.direction = mtlx_to_light;
}"""

# A height becomes a normal by its differences, which MaterialX takes from the screen. Here the nodes are evaluated three
# times: a step aside, a step along, and at the place. The step is small beside what maps resolve, large beside rounding.
HEIGHTS = """const float mtlx_step = 1.0 / 2048.0;
int mtlx_pass = 2;
int mtlx_height = 0;
vec3 mtlx_heights[32];
void mx_heighttonormal_vector3(float height, float scale, vec2 texcoord, out vec3 result)
{
    vec3 here = vec3(texcoord, height * scale / 16.0);
    int i = 2 * min(mtlx_height++, 15);
    result = vec3(0.5, 0.5, 1.0);
    if (mtlx_pass < 2) {
        mtlx_heights[i + mtlx_pass] = here;
        return;
    }
    vec3 n = cross(mtlx_heights[i] - here, mtlx_heights[i + 1] - here);
    if (dot(n, n) > 0.0) result = normalize(n.z < 0.0 ? -n : n) * 0.5 + 0.5;
}"""
STEPS = """  Surface aside = at;
  for (mtlx_pass = 0; mtlx_pass < 2; mtlx_pass++) {
    vec3 along = mtlx_pass == 0 ? at.tangent : cross(at.normal, at.tangent);
    aside.position = at.position + along * mtlx_step;
    aside.uv = at.uv + (mtlx_pass == 0 ? vec2(mtlx_step, 0.0) : vec2(0.0, mtlx_step));
    mtlx_height = 0;
    mtlx_nodes(aside, p);
  }
  mtlx_height = 0;
"""


class Unsupported(Exception):
    """What cannot be done, in one line."""


def load(path, name=""):
    """The document and its material of that name, or its one material."""
    import MaterialX as mx

    libraries = mx.createDocument()
    mx.loadLibraries(mx.getDefaultDataLibraryFolders(), mx.getDefaultDataSearchPath(), libraries)
    document = mx.createDocument()
    mx.readFromXmlFile(document, path)
    document.setDataLibrary(libraries)
    valid, message = document.validate()
    if not valid:
        raise Unsupported(message)
    materials = document.getMaterialNodes()
    names = ", ".join(material.getName() for material in materials)
    if not name and len(materials) != 1:
        choice = f": choose with {os.path.basename(path)}#NAME" if materials else ""
        raise Unsupported(f"expected one material, found {names or 'none'}{choice}")
    for material in materials:
        if name in ("", material.getName()):
            return document, libraries, material
    raise Unsupported(f"expected a material '{name}', found {names or 'none'}")


def converters(generator, libraries):
    """What colour spaces and units in the document are converted by."""
    import MaterialX as mx
    from MaterialX import PyMaterialXGenShader as gen

    colors = gen.DefaultColorManagementSystem.create(generator.getTarget())
    colors.loadLibrary(libraries)
    generator.setColorManagementSystem(colors)
    registry = mx.UnitConverterRegistry.create()
    for unit in ("distance", "angle"):
        definition = libraries.getUnitTypeDef(unit)
        registry.addUnitConverter(definition, mx.LinearUnitConverter.create(definition))
    units = gen.UnitSystem.create(generator.getTarget())
    units.loadLibrary(libraries)
    units.setUnitConverterRegistry(registry)
    generator.setUnitSystem(units)


def generate(libraries, material):
    """The generator's pixel shader, with every value that is not connected written out."""
    import MaterialX as mx
    from MaterialX import PyMaterialXGenGlsl as glsl
    from MaterialX import PyMaterialXGenShader as gen

    generator = glsl.VkShaderGenerator.create()
    converters(generator, libraries)
    context = gen.GenContext(generator)
    context.registerSourceCodeSearchPath(mx.getDefaultDataSearchPath())
    options = context.getOptions()
    options.shaderInterfaceType = gen.ShaderInterfaceType.SHADER_INTERFACE_REDUCED
    options.hwSpecularEnvironmentMethod = gen.HwSpecularEnvironmentMethod.SPECULAR_ENVIRONMENT_NONE
    options.hwMaxActiveLightSources = 1
    options.fileTextureVerticalFlip = True  # rows of redmap's pictures go down, MaterialX's v goes up
    options.targetColorSpaceOverride = "lin_rec709"
    options.targetDistanceUnit = "meter"
    return generator.generate("redmap", material, context).getSourceCode("pixel")


def values_of(members, table, path):
    """Statements that set the members of `vd` as `table` says."""
    lines = []
    for _, name in members:
        found = [value for pattern, value in table.items() if re.fullmatch(pattern, name)]
        if not found:
            wanted = name.removeprefix("i_geomprop_")
            raise Unsupported(f"expected positions, normals, tangents and the first uv of the surface, found '{wanted}'")
        lines.append(f"  vd.{name} = {found[0]};")
    return "\n".join(lines)


def members_of(block):
    return re.findall(r"^\s*(\w+) (\w+)(?:\[\w+\])?;", block, re.M)


class Text:
    """The generator's text, taken apart: `head` is all functions, `main` the statements of main()."""

    def __init__(self, source, path):
        self.path = path
        source = re.sub(r"^#(version|pragma).*\n", "", source, flags=re.M)
        source = source.replace("#define material surfaceshader\n", "")
        source = self.without_surroundings(source)
        # The only light needs no array.
        source = re.sub(r"u_lightData\[activeLightIndex\]", "LightData(0, 0.0, 0.0, 0.0)", source)
        source, main = source.split("void main()\n{\n")
        self.main = re.sub(r"^(\s*)material ", r"\1surfaceshader ", main[: main.rindex("}")], flags=re.M)
        self.head = self.replace_renderer(source)
        self.differs = len(re.findall(r"\bmx_heighttonormal_vector3\(", self.head + self.main)) > 1

    def replace_renderer(self, text):
        block = re.search(r"layout \([^)]*\) in VertexData\n\{\n(.*?)\} vd;\n", text, re.S)
        self.vertex_data = members_of(block.group(1)) if block else []
        # A structure without members is none.
        struct = "struct VertexData\n{\n" + (block.group(1) if block else "") + "    float unused;\n};\nVertexData vd;\n"
        text = text.replace(block.group(0), struct + RENDERER) if block else struct + RENDERER + text
        uniforms = []
        for found in re.finditer(r"layout \(std140[^)]*\) uniform \w+\n\{\n(.*?)\};\n", text, re.S):
            uniforms += members_of(found.group(1))
        text = re.sub(r"layout \(std140[^)]*\) uniform \w+\n\{\n.*?\};\n", "", text, flags=re.S)
        text = re.sub(r"layout \([^)]*\) (uniform sampler2D \w+;)", r"\n\1\n", text)
        text = re.sub(r"layout \([^)]*\) out vec4 (\w+);", r"vec4 \1;", text)
        text = self.declare(uniforms) + text
        text = re.sub(r"void sampleLightSource\(.*?\n\}", LIGHT, text, flags=re.S)
        text = re.sub(r"void mx_heighttonormal_vector3\(.*?\n\}", HEIGHTS, text, flags=re.S)
        # Antialiasing of its own is left out, and subsurface scattering takes the curvature of an object of radius 1.
        text = text.replace("length(fwidth(N)) / length(fwidth(P))", "1.0")
        return re.sub(r"(float mx_aastep\(float threshold, float value\)\s*\{).*?\n\}", r"\1 return step(threshold, value); }",
                      text, flags=re.S)

    @staticmethod
    def without_surroundings(text):
        """Without what closures get from an environment that is black, which is two thirds of what there is to compile."""
        text = re.sub(r"^( +)// Add environment contribution\n\1\{\n.*?^\1\}\n", "", text, flags=re.M | re.S)
        text = re.sub(r"^ +// Calculate the BSDF transmission for viewing direction\n.*?\.color \+= \w+\.response;\n", "", text,
                      flags=re.M | re.S)
        loop = r"for \(int activeLightIndex = 0; activeLightIndex < numLights; \+\+activeLightIndex\)"
        return re.sub(loop, "if (numLights > 0)", text)

    def declare(self, uniforms):
        """Uniforms become variables: the viewer and the lights are set, time is the Surface's, others are the document's."""
        known = {"u_viewPosition": "vec3", "u_numActiveLightSources": "int", "u_time": "float", "u_frame": "float"}
        self.uniforms = [name for _, name in uniforms if name in known]
        always = ["u_viewPosition", "u_numActiveLightSources"]
        lines = [f"{known[name]} {name};" for name in always + [name for name in self.uniforms if name not in always]]
        if not any(name == "u_refractionTwoSided" for _, name in uniforms):
            lines.append("const bool u_refractionTwoSided = false;")
        return "\n".join(lines) + "\n"

    def place(self):
        lines = [values_of(self.vertex_data, VERTEX_DATA, self.path)]
        # Frames are MaterialX's own twenty-four a second.
        for name, value in {"u_time": "at.time", "u_frame": "at.time * 24.0"}.items():
            if name in self.uniforms:
                lines.append(f"  {name} = {value};")
        return "\n".join(lines)

    def images(self):
        return re.findall(r"^uniform sampler2D (\w+);", self.head, re.M)


def split_arguments(text):
    """At the commas that are in no brackets."""
    parts, depth = [""], 0
    for character in text:
        depth += {"(": 1, ")": -1}.get(character, 0)
        if character == "," and depth == 0:
            parts.append("")
        else:
            parts[-1] += character
    return [part.strip() for part in parts]


def is_written_out(argument):
    return re.fullmatch(r"(vec[234]|mat[34])?\(?[-+\d.e, ]+\)?|true|false", argument) is not None


class SurfaceCall:
    """The one call of a surface shader that a main() ends with, or nothing where it has another form."""

    def __init__(self, text):
        calls = list(re.finditer(r"^\s*surfaceshader (\w+) = surfaceshader\(vec3\(0\.0\),vec3\(0\.0\)\);\n"
                                 r"\s*(\w+)\((.*), \1\);\n", text.main, re.M))
        others = len(re.findall(r"^\s*surfaceshader \w+ = surfaceshader\(", text.main, re.M))
        self.found = len(calls) == 1 and others == 1
        if not self.found:
            return
        self.function = calls[0].group(2)
        self.before = text.main[: calls[0].start()]
        signature = re.search(rf"^void {self.function}\((.*), out surfaceshader \w+\)", text.head, re.M)
        inputs = [part.split() for part in split_arguments(signature.group(1))]
        self.arguments = [(type, name, argument)
                          for (type, name), argument in zip(inputs, split_arguments(calls[0].group(3)))]
        self.shading_normal = self.find_shading_normal()

    def is_geometric(self, argument, member):
        """Whether the argument is the surface's own normal or tangent."""
        return re.search(rf"\b{argument} = normalize\(vd\.{member}(World|Object)\);", self.before) is not None

    def find_shading_normal(self):
        for type, name, argument in self.arguments:
            if type == "vec3" and name in ("normal", "geometry_normal") and not self.is_geometric(argument, "normal"):
                return None if is_written_out(argument) else argument
        return None

    def is_direction(self, type, name):
        return type == "vec3" and re.search(r"normal|tangent", name) is not None

    def members(self):
        """(type, name, value) of all that the place decides."""
        found = []
        for type, name, argument in self.arguments:
            if is_written_out(argument) or self.in_frame(name, argument):
                continue
            value = f"mtlx_in_frame({argument})" if self.is_direction(type, name) else argument
            found.append(("int", name, f"int({value})") if type == "bool" else (type, name, value))
        return found

    def in_frame(self, name, argument):
        """What the argument is in the shading frame, where that is known."""
        if argument == self.shading_normal and name in ("normal", "geometry_normal"):
            return NORMAL
        if self.shading_normal is None and self.is_geometric(argument, "normal"):
            return NORMAL
        # The frame's x is the tangent made perpendicular, as every closure makes it.
        if self.is_geometric(argument, "tangent"):
            return TANGENT
        if "coat_normal" in name and any(self.is_zero(weight) for weight in ("coat", "coat_weight", "clearcoat")):
            return NORMAL  # of no coat
        return None

    def call(self, result):
        values = []
        for type, name, argument in self.arguments:
            known = argument if is_written_out(argument) else self.in_frame(name, argument)
            stored = f"bool(m.in_{name})" if type == "bool" else f"m.in_{name}"
            values.append(known or stored)
        return f"{self.function}({', '.join(values)}, {result});"

    def is_zero(self, name):
        values = [argument for _, found, argument in self.arguments if found == name]
        return any(re.fullmatch(r"(vec3\()?[0., ]+\)?", value) for value in values)

    def emits(self):
        names = [name for _, name, _ in self.arguments if "emi" in name and "emissivity" not in name]
        return bool(names) and not any(self.is_zero(name) for name in names)

    def transmits(self):
        opacities = [a for _, name, a in self.arguments if name in ("opacity", "geometry_opacity", "alpha")]
        return any(not re.fullmatch(r"(vec3\()?[1., 0]*1[., 01]*\)?", value) for value in opacities)


def evaluate(text, body):
    """`mtlx_evaluate(at, p)`, which runs `body` at a place, after the steps that heights need."""
    return f"""
void mtlx_nodes(Surface at, Parameters p) {{
{text.place()}
{body}}}
void mtlx_evaluate(Surface at, Parameters p) {{
{STEPS if text.differs else ""}  mtlx_nodes(at, p);
}}
"""


def split_form(text, call):
    members = call.members()
    declared = "".join(f"  {type} in_{name};\n" for type, name, _ in members) or "  float nothing;\n"
    normal = call.shading_normal or "vd_normal"
    frame = f"  vec3 vd_normal = mtlx_at.normal;\n  mtlx_normal = normalize({normal});\n"
    stored = "".join(f"  mtlx_pattern.in_{name} = {value};\n" for _, name, value in members)
    functions = evaluate(text, call.before + "  mtlx_at = at;\n" + frame + stored)
    parts = [
        f"struct Pattern {{\n{declared}}};\nPattern mtlx_pattern;\nSurface mtlx_at;\nvec3 mtlx_normal;\n",
        "vec3 mtlx_in_frame(vec3 d) {\n  vec3 x = normalize(mtlx_at.tangent - mtlx_normal * dot(mtlx_at.tangent, mtlx_normal));"
        "\n  return vec3(dot(d, x), dot(d, cross(mtlx_normal, x)), dot(d, mtlx_normal));\n}\n",
        functions,
        "Pattern pattern(Surface at, Parameters p) {\n  mtlx_evaluate(at, p);\n  return mtlx_pattern;\n}\n",
        "surfaceshader mtlx_shade(Pattern m, vec3 to_viewer, int lights) {\n"
        + values_of(text.vertex_data, SHADING_FRAME, text.path)
        + "\n  u_viewPosition = to_viewer;\n  u_numActiveLightSources = lights;\n"
        f"  surfaceshader result = surfaceshader(vec3(0.0), vec3(0.0));\n  {call.call('result')}\n  return result;\n}}\n",
        radiance_of_split(call.emits()),
    ]
    if call.shading_normal:
        parts.append("vec3 shading_normal(Surface at, Parameters p) {\n  mtlx_evaluate(at, p);\n  return mtlx_normal;\n}\n")
    if call.emits():
        parts.append(f"vec3 emission(Pattern m) {{ return mtlx_shade(m, {NORMAL}, 0).color; }}\n")
    if call.transmits():
        parts.append(f"vec3 transmittance(Pattern m) {{ return clamp(mtlx_shade(m, {NORMAL}, 0).transparency, 0.0, 1.0); }}\n")
    return "\n".join(parts)


def radiance_of_split(emits):
    unlit = "\n  lit -= mtlx_shade(m, to_viewer, 0).color;" if emits else ""
    return ("vec3 radiance(Pattern m, vec3 to_light, vec3 to_viewer) {\n"
            "  if (to_light.z <= 0.0 || to_viewer.z <= 0.0) return vec3(0.0);\n"
            "  mtlx_to_light = to_light;\n  mtlx_irradiance = vec3(1.0);\n"
            f"  vec3 lit = mtlx_shade(m, to_viewer, 1).color;{unlit}\n  return max(lit, vec3(0.0));\n}}\n")


def black_box(text):
    has_position = any(name == "positionWorld" for _, name in text.vertex_data)
    viewer = f"  u_viewPosition = {'vd.positionWorld' if has_position else 'vec3(0.0)'} + mtlx_to_viewer;\n"
    return ("vec3 mtlx_to_viewer;\n" + evaluate(text, viewer + text.main) +
            "vec3 radiance(Surface at, Parameters p, vec3 to_light, vec3 to_viewer) {\n"
            "  if (dot(to_light, at.normal) <= 0.0 || dot(to_viewer, at.normal) <= 0.0) return vec3(0.0);\n"
            "  mtlx_to_light = to_light;\n  mtlx_to_viewer = to_viewer;\n  mtlx_irradiance = vec3(1.0);\n"
            "  u_numActiveLightSources = 1;\n  mtlx_evaluate(at, p);\n  vec3 lit = out1.rgb;\n"
            "  u_numActiveLightSources = 0;\n  mtlx_evaluate(at, p);\n  return max(lit - out1.rgb, vec3(0.0));\n}\n")


def files_of(document, samplers, path):
    """The file of every sampler, which is called after its node and input: NODE_file."""
    files = {}
    for element in document.traverseTree():
        if element.getCategory() == "input" and element.getAttribute("type") == "filename":
            node = element.getParent()
            for sampler in samplers:
                if sampler.endswith(f"{node.getName()}_{element.getName()}") and element.getValueString():
                    name = os.path.join(os.path.dirname(path), element.getResolvedValueString())
                    if not os.path.isfile(name):
                        raise Unsupported(f"node '{node.getName()}': expected a picture, found no file {name}")
                    files[sampler] = name
    for sampler in samplers:
        if sampler not in files:
            raise Unsupported(f"expected a file for the image '{sampler}', found none")
    return files


def translate(path: str) -> tuple[str, dict[str, str]]:
    """The shader's text and the files of its images. Raises Unsupported."""
    path, _, name = path.partition("#") if ".mtlx#" in path else (path, "", "")
    document, libraries, material = load(path, name)
    text = Text(generate(libraries, material), path)
    call = SurfaceCall(text)
    head = (f"// {material.getName()}, a MaterialX material.\nstruct Parameters {{\n"
            "  float scale;  // 1 [0.001, 1000]: times that positions and uv are taken: finer patterns\n};\n")
    body = split_form(text, call) if call.found else black_box(text)
    return head + text.head + body, files_of(document, text.images(), path)


def main(path):
    try:
        text, images = translate(path)
        print(json.dumps({"text": text, "images": images}))
    except ModuleNotFoundError:
        print(json.dumps({"error": f"expected Python's module MaterialX (pip install materialx), found none in {sys.executable}"}))
    except Exception as problem:  # whatever MaterialX throws is about the document
        line = " ".join(str(problem).split()) or type(problem).__name__
        print(json.dumps({"error": line if line.startswith(path) else f"{path}: {line}"}))


if __name__ == "__main__":
    main(sys.argv[1])
