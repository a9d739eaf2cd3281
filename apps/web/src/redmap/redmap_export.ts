// An exported map in memory, as three.js takes it: geometry, textures and the text of its shader.
import {
  BufferGeometry,
  ClampToEdgeWrapping,
  CompressedArrayTexture,
  DataTexture,
  InterleavedBuffer,
  InterleavedBufferAttribute,
  BufferAttribute,
  LinearFilter,
  LinearMipmapLinearFilter,
  NearestFilter,
  RedIntegerFormat,
  RepeatWrapping,
  RGBAFormat,
  UnsignedByteType,
  UnsignedIntType,
  type CompressedPixelFormat,
  type PixelFormatGPU,
} from 'three';
import { RedmapError } from './json_reader.js';
import type { RedmapManifest } from './manifest.js';

/** Floats of a vertex in mesh.bin: position, normal, tangent, uv, triangle. */
const kVertexFloats = 12;

/** The files of an export, not yet looked into. */
export interface RedmapBytes {
  include: ArrayBuffer;
  weights: ArrayBuffer;
  words: ArrayBuffer;
  mesh: ArrayBuffer;
}

export interface RedmapExport {
  manifest: RedmapManifest;
  /** redmap.glsl. */
  text: string;
  /** position, normal, uv (of the map, v upwards), redmap_tangent and redmap_triangle. */
  geometry: BufferGeometry;
  weights: CompressedArrayTexture;
  words: DataTexture;
  dispose(): void;
}

function requireBytes(bytes: ArrayBuffer, expected: number, file: string, what: string): void {
  if (bytes.byteLength !== expected)
    throw new RedmapError(`${file}: expected ${expected} bytes (${what}), found ${bytes.byteLength}`);
}

interface Level {
  data: Uint8Array;
  width: number;
  height: number;
}

/** All levels of the weights, each all of its layers. */
function levelsOf({ weights }: RedmapManifest, bytes: ArrayBuffer): Level[] {
  const { width, height, layers, levels } = weights;
  const all: Level[] = [];
  let at = 0;
  for (let level = 0; level < levels; ++level) {
    const w = Math.max(1, width >> level);
    const h = Math.max(1, height >> level);
    const end = at + w * h * layers * 4;
    all.push({ data: new Uint8Array(bytes.slice(at, end)), width: w, height: h });
    at = end;
  }
  requireBytes(bytes, at, weights.file, `${levels} levels of ${width} x ${height} x ${layers}, RGBA8`);
  return all;
}

/** three.js sends levels of our own to an array texture only if it is called a compressed one. */
function weightTexture(manifest: RedmapManifest, bytes: ArrayBuffer): CompressedArrayTexture {
  const { width, height, layers, wraps_u } = manifest.weights;
  const levels = levelsOf(manifest, bytes);
  const format = RGBAFormat as unknown as CompressedPixelFormat;
  const texture = new CompressedArrayTexture(levels as never, width, height, layers, format, UnsignedByteType);
  texture.minFilter = LinearMipmapLinearFilter;
  texture.magFilter = LinearFilter;
  texture.wrapS = wraps_u ? RepeatWrapping : ClampToEdgeWrapping;
  texture.wrapT = ClampToEdgeWrapping;
  texture.generateMipmaps = false;
  texture.needsUpdate = true;
  return texture;
}

function wordTexture({ words }: RedmapManifest, bytes: ArrayBuffer): DataTexture {
  requireBytes(bytes, 4 * words.width * words.height, words.file, `${words.width} x ${words.height} words`);
  const texture = new DataTexture(new Uint32Array(bytes), words.width, words.height, RedIntegerFormat, UnsignedIntType);
  texture.internalFormat = 'R32UI' satisfies PixelFormatGPU;
  texture.minFilter = texture.magFilter = NearestFilter;
  texture.needsUpdate = true;
  return texture;
}

function geometryOf({ mesh }: RedmapManifest, bytes: ArrayBuffer): BufferGeometry {
  const { vertices, indices, file } = mesh;
  const first = 4 * kVertexFloats * vertices;
  requireBytes(bytes, first + 4 * indices, file, `${vertices} vertices, ${indices} indices`);
  const index = new Uint32Array(bytes.slice(first));
  if (indices % 3 !== 0) throw new RedmapError(`${file}: expected triangles, found ${indices} indices`);
  const wrong = index.findIndex(i => i >= vertices);
  if (wrong >= 0)
    throw new RedmapError(`${file}: index ${wrong}: expected less than ${vertices} vertices, found ${index[wrong]}`);
  const all = new InterleavedBuffer(new Float32Array(bytes.slice(0, first)), kVertexFloats);
  const geometry = new BufferGeometry();
  const parts = { position: [3, 0], normal: [3, 3], redmap_tangent: [3, 6], uv: [2, 9], redmap_triangle: [1, 11] };
  for (const [name, [size, offset]] of Object.entries(parts))
    geometry.setAttribute(name, new InterleavedBufferAttribute(all, size!, offset!));
  geometry.setIndex(new BufferAttribute(index, 1));
  geometry.computeBoundingSphere();
  return geometry;
}

/** Checks the files against the manifest and makes geometry and textures of them. Throws RedmapError. */
export function makeExport(manifest: RedmapManifest, bytes: RedmapBytes): RedmapExport {
  const text = new TextDecoder().decode(bytes.include);
  if (!text.includes('redmap_shade('))
    throw new RedmapError(`${manifest.include.file}: expected a function redmap_shade(), found none`);
  const geometry = geometryOf(manifest, bytes.mesh);
  const weights = weightTexture(manifest, bytes.weights);
  const words = wordTexture(manifest, bytes.words);
  const dispose = () => [geometry, weights, words].forEach(each => each.dispose());
  return { manifest, text, geometry, weights, words, dispose };
}
