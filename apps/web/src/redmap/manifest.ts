// manifest.json of `redmap export --to glsl`: its types, and the checks that make the rest of the loader safe.
import { JsonReader } from './json_reader.js';

/** A file of the export, and the same compressed by gzip where there is one. */
export interface RedmapFile {
  file: string;
  gzip?: string;
}

/** A parameter of the shader, as its text declares it. */
export interface RedmapParameter {
  name: string;
  type: 'float' | 'int' | 'vec2' | 'vec3';
  /** What the map was baked with. */
  value: number[];
  minimum: number;
  maximum: number;
  unit: string;
  meaning: string;
  /** Whether the map holds for its other values too: it changes the look of the parts, not where they are. */
  live: boolean;
}

export interface RedmapManifest {
  name: string;
  shader: string;
  /** How many basis reflectances. */
  basis: number;
  include: RedmapFile;
  weights: RedmapFile & { width: number; height: number; layers: number; levels: number; wraps_u: boolean };
  words: RedmapFile & { width: number; height: number };
  mesh: RedmapFile & { vertices: number; indices: number };
  parameters: RedmapParameter[];
}

function filesOf(at: JsonReader): RedmapFile {
  const file = at.at('file').fileName();
  const gzip = at.at('gzip');
  return gzip.value === undefined ? { file } : { file, gzip: gzip.fileName() };
}

const kComponents = { float: 1, int: 1, vec2: 2, vec3: 3 };
/** What WebGL2 implementations have at most, and twice that. */
const kMostTexels = 1 << 15;
const kMostVertices = 1 << 28;

function parameterOf(at: JsonReader): RedmapParameter {
  const type = at.at('type').text() as RedmapParameter['type'];
  if (!(type in kComponents)) at.at('type').fail('float, int, vec2 or vec3');
  const value = at.at('value').list(each => each.number());
  if (value.length !== kComponents[type]) at.at('value').fail(`${kComponents[type]} numbers`);
  return {
    name: at.at('name').text(),
    type,
    value,
    minimum: at.at('minimum').number(),
    maximum: at.at('maximum').number(),
    unit: at.at('unit').text(),
    meaning: at.at('meaning').text(),
    live: at.at('live').flag(),
  };
}

/** Checks a parsed manifest. `file` is what errors call it. Throws RedmapError. */
export function readManifest(document: unknown, file: string): RedmapManifest {
  const all = new JsonReader(file, '', document);
  if (all.at('redmap_export').value !== 1) all.at('redmap_export').fail('1, an export of redmap');
  if (all.at('kind').value !== 'glsl') all.at('kind').fail('"glsl" (redmap export --to glsl)');
  const weights = all.at('weights');
  const words = all.at('words');
  const mesh = all.at('mesh');
  const parameters = all.at('parameters');
  return {
    name: all.at('name').text(),
    shader: all.at('shader').text(),
    basis: all.at('basis').count(1, 16),
    include: { file: all.at('include').fileName() },
    weights: {
      ...filesOf(weights),
      width: weights.at('width').count(1, kMostTexels),
      height: weights.at('height').count(1, kMostTexels),
      layers: weights.at('layers').count(1, 8),
      levels: weights.at('levels').count(1, 16),
      wraps_u: weights.at('wraps_u').flag(),
    },
    words: {
      ...filesOf(words),
      width: words.at('width').count(1, 2048),
      height: words.at('height').count(1, kMostTexels),
    },
    mesh: {
      ...filesOf(mesh),
      vertices: mesh.at('vertices').count(1, kMostVertices),
      indices: mesh.at('indices').count(3, kMostVertices),
    },
    parameters: parameters.value === undefined ? [] : parameters.list(parameterOf),
  };
}
