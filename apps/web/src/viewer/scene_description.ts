// scene.json, which `redmap view --web` writes: camera, lights, and objects with the folders of their exports.
import { JsonReader, RedmapError } from '../redmap/json_reader.js';

export type Triple = [number, number, number];

export interface CameraDescription {
  position: Triple;
  lookAt: Triple;
  up: Triple;
  verticalFovDegrees: number;
}

/** Intensity is linear: irradiance of directional lights, irradiance at distance 1 of points. */
export interface LightDescription {
  name: string;
  type: 'point' | 'directional';
  /** Of a point; of a directional light the way to it. World space. */
  place: Triple;
  intensity: Triple;
}

export interface ObjectDescription {
  name: string;
  /** Of its export, with a slash at its end. */
  folder: string;
  /** Object to world, column by column: turned, moved, scaled evenly. */
  matrix: number[];
}

export interface SceneDescription {
  name: string;
  background: Triple;
  camera: CameraDescription;
  lights: LightDescription[];
  objects: ObjectDescription[];
}

function numbersOf(at: JsonReader, count: number): number[] {
  const numbers = at.list(each => each.number());
  return numbers.length === count ? numbers : at.fail(`${count} numbers`);
}
const tripleOf = (at: JsonReader) => numbersOf(at, 3) as Triple;

function lightOf(at: JsonReader): LightDescription {
  const type = at.at('type').text();
  if (type !== 'point' && type !== 'directional') at.at('type').fail('"point" or "directional"');
  const isPoint = type === 'point';
  return {
    name: at.at('name').text(),
    type: isPoint ? 'point' : 'directional',
    place: tripleOf(at.at(isPoint ? 'position' : 'to_light')),
    intensity: tripleOf(at.at('intensity')),
  };
}

/** Checks a parsed scene.json from `base`, a folder with a slash at its end. Throws RedmapError. */
function readScene(document: unknown, base: string, file: string): SceneDescription {
  const all = new JsonReader(file, '', document);
  if (all.at('redmap_scene').value !== 1) all.at('redmap_scene').fail('1, a scene of redmap');
  const camera = all.at('camera');
  return {
    name: all.at('name').text(),
    background: tripleOf(all.at('background')),
    camera: {
      position: tripleOf(camera.at('position')),
      lookAt: tripleOf(camera.at('look_at')),
      up: tripleOf(camera.at('up')),
      verticalFovDegrees: camera.at('vertical_fov_degrees').number(),
    },
    lights: all.at('lights').list(lightOf),
    objects: all.at('objects').list(object => ({
      name: object.at('name').text(),
      folder: `${base}${object.at('folder').fileName()}/`,
      matrix: numbersOf(object.at('matrix'), 16),
    })),
  };
}

/** One export alone: a light over the shoulder, and a camera that sees a unit sphere at the origin. */
function sceneOfExport(folder: string): SceneDescription {
  return {
    name: '',
    background: [0.18, 0.18, 0.18],
    camera: { position: [0, 0, 4], lookAt: [0, 0, 0], up: [0, 1, 0], verticalFovDegrees: 40 },
    lights: [{ name: 'light', type: 'directional', place: [0.4, 0.5, 0.7], intensity: [3, 3, 3] }],
    objects: [{ name: '', folder, matrix: [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1] }],
  };
}

const asFolder = (path: string) => (path.endsWith('/') ? path : `${path}/`);

/** What the address asks for: `?scene=FOLDER` (default: scene), or `?export=FOLDER`. Throws RedmapError. */
export async function loadScene(query: URLSearchParams): Promise<SceneDescription> {
  if (location.protocol === 'file:')
    throw new RedmapError(
      'This page was opened as a file, and browsers let files read no others. Serve its folder, for example with ' +
        'python3 -m http.server, and open the address that it prints.',
    );
  const folder = query.get('export');
  if (folder) return sceneOfExport(asFolder(folder));
  const base = asFolder(query.get('scene') ?? 'scene');
  const file = `${base}scene.json`;
  const response = await fetch(file).catch(() => undefined);
  if (!response?.ok)
    throw new RedmapError(`${file}: expected a scene, found ${response ? `status ${response.status}` : 'no answer'}`);
  const document: unknown = await response.json().catch(() => {
    throw new RedmapError(`${file}: expected JSON, found something else`);
  });
  return readScene(document, base, file);
}
