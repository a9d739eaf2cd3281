// The scene in three.js, and its pictures by each method, side by side.
import {
  AmbientLight,
  Color,
  DirectionalLight,
  LinearSRGBColorSpace,
  Matrix4,
  Mesh,
  PerspectiveCamera,
  PointLight,
  Scene,
  Vector3,
  WebGLRenderer,
  type Light,
  type Sphere,
} from 'three';
import { RedmapError, RedmapLoader, RedmapMaterial, type RedmapExport } from '../redmap/index.js';
import { boundsOf } from './orbit_view.js';
import type { LightDescription, SceneDescription } from './scene_description.js';
import { kMostSamples, kSamples, Supersampler, type Region } from './supersampler.js';

export type Method = 'original' | 'map' | 'supersampled';
export const kMethods: { method: Method; label: string }[] = [
  { method: 'original', label: 'Original' },
  { method: 'map', label: 'Reduction map' },
  { method: 'supersampled', label: `${kSamples} samples` },
];

/** A frame of supersampling is spread over several where it would take longer than this. */
const kFrameMilliseconds = 100;

export interface StageObject {
  name: string;
  exported: RedmapExport;
  material: RedmapMaterial;
  mesh: Mesh;
}
export interface StageLight {
  description: LightDescription;
  light: Light & { position: Vector3 };
}

/** What drawing a side took, and how many samples a pixel it has. */
export interface Drawn {
  milliseconds: number;
  samples: number;
}

function makeRenderer(canvas: HTMLCanvasElement): WebGLRenderer {
  const context = canvas.getContext('webgl2', { antialias: true, powerPreference: 'high-performance' });
  if (!context)
    throw new RedmapError('This page needs WebGL2, which this browser has not, or has turned off for this device.');
  if (!context.getExtension('EXT_color_buffer_float') && !context.getExtension('EXT_color_buffer_half_float'))
    throw new RedmapError('This page needs textures of half floats to draw to, which this device has not.');
  return new WebGLRenderer({ canvas, context, antialias: true });
}

const linear = ([r, g, b]: readonly [number, number, number]) => new Color().setRGB(r, g, b, LinearSRGBColorSpace);

function makeLight(description: LightDescription): StageLight {
  const isPoint = description.type === 'point';
  const light = isPoint ? new PointLight() : new DirectionalLight();
  light.color = linear(description.intensity);
  light.position.set(...description.place);
  return { description, light };
}

export class Stage {
  readonly scene = new Scene();
  readonly camera = new PerspectiveCamera();
  readonly objects: StageObject[] = [];
  readonly lights: StageLight[];
  readonly renderer: WebGLRenderer;
  bounds!: Sphere;
  readonly #supersamplers: [Supersampler, Supersampler];
  readonly #sampleMilliseconds = [0, 0];

  constructor(
    readonly canvas: HTMLCanvasElement,
    readonly description: SceneDescription,
  ) {
    this.renderer = makeRenderer(canvas);
    this.renderer.debug.onShaderError = (gl, _program, _vertex, fragment) => {
      throw new RedmapError(`redmap.glsl: expected GLSL that compiles, found: ${gl.getShaderInfoLog(fragment)}`);
    };
    this.#supersamplers = [new Supersampler(this.renderer), new Supersampler(this.renderer)];
    this.scene.background = linear(description.background);
    this.camera.fov = description.camera.verticalFovDegrees;
    this.lights = description.lights.map(makeLight);
    for (const { light } of this.lights) this.scene.add(light);
    // Lights the redmap materials do not know; three.js asks for one at least.
    this.scene.add(new AmbientLight(0));
  }

  /** Loads the exports; `onProgress`: part of the bytes that are known of. Throws RedmapError. */
  async load(onProgress: (part: number) => void): Promise<void> {
    const parts = this.description.objects.map(() => 0);
    const load = async (folder: string, i: number): Promise<RedmapExport> =>
      new RedmapLoader().loadAsync(folder, ({ loaded, total }) => {
        parts[i] = total > 0 ? loaded / total : 0;
        onProgress(parts.reduce((sum, part) => sum + part, 0) / parts.length);
      });
    const all = await Promise.all(this.description.objects.map(({ folder }, i) => load(folder, i)));
    performance.mark('redmap-loaded');
    all.forEach((exported, i) => this.#add(this.description.objects[i]!, exported));
    const spheres = this.objects.map(({ mesh }) => mesh.geometry.boundingSphere!);
    this.bounds = boundsOf(
      this.objects.map(({ mesh }) => mesh),
      spheres,
    );
    if (!(this.bounds.radius > 0)) throw new RedmapError('scene: expected an object to show, found none');
    // three.js complains where a device cannot compile beside the page.
    if (this.renderer.extensions.has('KHR_parallel_shader_compile'))
      await this.renderer.compileAsync(this.scene, this.camera);
  }

  #add({ name, matrix }: { name: string; matrix: number[] }, exported: RedmapExport): void {
    const { width, height, file } = exported.manifest.words;
    const most = this.renderer.capabilities.maxTextureSize;
    if (Math.max(width, height, exported.manifest.weights.width, exported.manifest.weights.height) > most)
      throw new RedmapError(`${file}: expected at most ${most} rows, which this device can hold, found ${height}`);
    const material = new RedmapMaterial(exported);
    const mesh = new Mesh(exported.geometry, material);
    mesh.applyMatrix4(new Matrix4().fromArray(matrix));
    mesh.updateMatrixWorld();
    this.scene.add(mesh);
    this.objects.push({ name: name || exported.manifest.name, exported, material, mesh });
  }

  /** In CSS pixels. */
  resize(width: number, height: number, pixelRatio: number): void {
    this.renderer.setPixelRatio(pixelRatio);
    this.renderer.setSize(width, height, false);
    this.camera.aspect = width / height;
    this.camera.updateProjectionMatrix();
  }

  /** What was shown so far is of another picture. */
  restart(): void {
    for (const each of this.#supersamplers) each.restart();
  }

  /** Whether another call of draw() would make the picture better. */
  isUnfinished(methods: readonly [Method, Method]): boolean {
    return methods.some((method, i) => method === 'supersampled' && this.#supersamplers[i]!.samples < kMostSamples);
  }

  /** Both sides of the divider, which stands at `part` of the width. */
  draw(methods: readonly [Method, Method], part: number): [Drawn, Drawn] {
    const { canvas, renderer } = this;
    const edge = Math.round(part * canvas.width);
    renderer.setScissorTest(true);
    const sides = [
      { x: 0, y: 0, width: edge, height: canvas.height },
      { x: edge, y: 0, width: canvas.width - edge, height: canvas.height },
    ].map((region, i) => this.#drawSide(i, methods[i]!, region));
    renderer.setScissorTest(false);
    return sides as [Drawn, Drawn];
  }

  #drawSide(side: number, method: Method, region: Region): Drawn {
    if (region.width === 0) return { milliseconds: 0, samples: 0 };
    const ratio = this.renderer.getPixelRatio();
    this.renderer.setScissor(region.x / ratio, region.y / ratio, region.width / ratio, region.height / ratio);
    for (const { material } of this.objects) material.method = method === 'map' ? 'map' : 'original';
    const start = performance.now();
    if (method !== 'supersampled') {
      this.renderer.render(this.scene, this.camera);
      this.#finish();
      return { milliseconds: performance.now() - start, samples: 1 };
    }
    return this.#supersample(side, region, start);
  }

  /** All samples of a frame at once where that is quick enough; else some, and the rest in the next frames. */
  #supersample(side: number, region: Region, start: number): Drawn {
    const by = this.#supersamplers[side]!;
    const one = this.#sampleMilliseconds[side]!;
    const wanted = by.samples === 0 ? kSamples : kMostSamples - by.samples;
    const affordable = one > 0 ? Math.max(1, Math.floor(kFrameMilliseconds / one)) : 1;
    const count = Math.min(wanted, affordable, kSamples);
    for (let i = 0; i < count; ++i) by.add(this.scene, this.camera, this.canvas.width, this.canvas.height, region);
    by.show();
    this.#finish();
    if (count > 0) this.#sampleMilliseconds[side] = (performance.now() - start) / count;
    return { milliseconds: kSamples * this.#sampleMilliseconds[side]!, samples: by.samples };
  }

  /** Waits for the device: reading a pixel is the one way that all browsers have. */
  #finish(): void {
    const gl = this.renderer.getContext();
    gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, new Uint8Array(4));
  }
}
