// A reduction map as a material of three.js. Takes the directional and point lights of the scene it is in.
import { DoubleSide, ShaderMaterial, UniformsLib, UniformsUtils, Vector4 } from 'three';
import { RedmapError } from './json_reader.js';
import type { RedmapParameter } from './manifest.js';
import { fragmentText, kVertexText, uniformOf } from './material_text.js';
import type { RedmapExport } from './redmap_export.js';

/** 'map': filtered by the map, and the shader itself close up. 'original': the shader itself, which aliases. */
export type RedmapMethod = 'map' | 'original';

export class RedmapMaterial extends ShaderMaterial {
  readonly exported: RedmapExport;
  readonly #viewport = new Vector4();

  constructor(exported: RedmapExport) {
    const { manifest } = exported;
    super({
      name: `redmap ${manifest.name}`,
      vertexShader: kVertexText,
      fragmentShader: fragmentText(manifest, exported.text),
      uniforms: UniformsUtils.clone(UniformsLib.lights),
      lights: true,
      side: DoubleSide,
    });
    this.exported = exported;
    this.uniforms['redmap_texels'] = { value: exported.weights };
    this.uniforms['redmap_words'] = { value: exported.words };
    this.uniforms['redmap_method'] = { value: 0 };
    this.uniforms['redmap_viewport'] = { value: this.#viewport };
    for (const parameter of manifest.parameters) this.setParameter(parameter.name, parameter.value);
    this.onBeforeRender = renderer => {
      renderer.getCurrentViewport(this.#viewport);
      this.uniformsNeedUpdate = true;
    };
  }

  get method(): RedmapMethod {
    return this.uniforms['redmap_method']!.value === 0 ? 'map' : 'original';
  }
  set method(method: RedmapMethod) {
    this.uniforms['redmap_method']!.value = method === 'map' ? 0 : 1;
  }

  /**
   * Changes a parameter of the shader, all of its components, clamped to its range. The map follows where the parameter is `live`;
   * else it shows the old pattern until it is baked again, and only the original changes. Throws RedmapError on an
   * unknown name.
   */
  setParameter(name: string, value: number | readonly number[]): void {
    const parameter = this.#parameter(name);
    const wanted = typeof value === 'number' ? [value] : [...value];
    if (wanted.length !== parameter.value.length)
      throw new RedmapError(`parameter ${name}: expected ${parameter.value.length} numbers, found ${wanted.length}`);
    const inRange = wanted.map(each => Math.min(Math.max(each, parameter.minimum), parameter.maximum));
    this.uniforms[uniformOf(parameter)] ??= { value: 0 };
    this.uniforms[uniformOf(parameter)]!.value = inRange.length === 1 ? inRange[0] : inRange;
  }

  /** The components of a parameter. Throws RedmapError on an unknown name. */
  parameter(name: string): number[] {
    const value = this.uniforms[uniformOf(this.#parameter(name))]!.value as number | number[];
    return typeof value === 'number' ? [value] : [...value];
  }

  /** Whether parameters that are not live differ from those of the bake: the map shows another pattern than the shader. */
  get isStale(): boolean {
    return this.exported.manifest.parameters.some(
      p => !p.live && this.parameter(p.name).some((value, i) => Math.abs(value - p.value[i]!) > 1e-6 * Math.abs(value)),
    );
  }

  #parameter(name: string): RedmapParameter {
    const all = this.exported.manifest.parameters;
    const found = all.find(each => each.name === name);
    if (found) return found;
    throw new RedmapError(`parameter: expected one of ${all.map(each => each.name).join(', ')}, found ${name}`);
  }
}
