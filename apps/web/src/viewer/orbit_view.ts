// A camera around a point: it turns, and it comes near what is in the middle of the picture without ever passing
// through.
import { MathUtils, Raycaster, Sphere, Spherical, Vector3, type Object3D, type PerspectiveCamera } from 'three';
import type { CameraDescription } from './scene_description.js';

/** Nearest and farthest, in radii of the scene; the farthest leaves it about two pixels. */
const kLeastGap = 0.01;
const kMostDistance = 2000;
const kLeastPolar = 0.02;
/** Degrees a pixel, far from the surface: half a picture is about half a turn. */
const kDragDegrees = 0.3;
/** How far apart the planes of the camera are around the scene. */
const kNearPart = 0.3;

export class OrbitView {
  readonly #home: { position: Vector3; up: Vector3 };
  readonly #pivot: Vector3;
  readonly #ray = new Raycaster();

  constructor(
    readonly camera: PerspectiveCamera,
    description: CameraDescription,
    readonly scene: Object3D,
    readonly bounds: Sphere,
  ) {
    this.#pivot = new Vector3(...description.lookAt);
    this.#home = { position: new Vector3(...description.position), up: new Vector3(...description.up) };
    this.home();
  }

  home(): void {
    this.camera.position.copy(this.#home.position);
    this.camera.up.copy(this.#home.up).normalize();
    this.#settle();
  }

  /** By pixels of the pointer: what is under it follows, close up as well. */
  drag(x: number, y: number, pictureHeight: number): void {
    const { gap, distance } = this.#reach();
    const pixel = (2 * Math.tan(MathUtils.degToRad(this.camera.fov / 2)) * gap) / pictureHeight;
    const following = MathUtils.radToDeg(pixel / Math.max(distance - gap, 1e-3 * this.bounds.radius));
    const degrees = Math.min(kDragDegrees, following);
    this.turn(-degrees * x, -degrees * y);
  }

  /** Around the point that it looks at, in degrees: to the right, and down. */
  turn(right: number, down: number): void {
    const toY = new Vector3(0, 1, 0);
    const upright = (v: Vector3, back: boolean) => {
      // Spherical coordinates are about y.
      const from = back ? toY : this.camera.up;
      const to = back ? this.camera.up : toY;
      const cosine = from.dot(to);
      const axis = Math.abs(cosine) > 0.99999 ? new Vector3(1, 0, 0) : from.clone().cross(to).normalize();
      return v.applyAxisAngle(axis, Math.acos(MathUtils.clamp(cosine, -1, 1)));
    };
    const away = upright(this.camera.position.clone().sub(this.#pivot), false);
    const at = new Spherical().setFromVector3(away);
    at.theta += MathUtils.degToRad(right);
    at.phi = MathUtils.clamp(at.phi + MathUtils.degToRad(down), kLeastPolar, Math.PI - kLeastPolar);
    this.camera.position.copy(this.#pivot).add(upright(new Vector3().setFromSpherical(at), true));
    this.zoom(1);
  }

  /** Multiplies the distance to the surface in the middle of the picture by `factor`. */
  zoom(factor: number): void {
    const { gap, distance } = this.#reach();
    const { radius } = this.bounds;
    const next = MathUtils.clamp(
      distance - gap + Math.max(gap * factor, kLeastGap * radius),
      0,
      kMostDistance * radius,
    );
    const away = this.camera.position.clone().sub(this.#pivot).normalize();
    this.camera.position.copy(this.#pivot).addScaledVector(away, next);
    this.#settle();
  }

  /** About how many pixels high the scene is. */
  heightPixels(pictureHeight: number): number {
    const distance = this.camera.position.distanceTo(this.bounds.center);
    return (this.bounds.radius / (distance * Math.tan(MathUtils.degToRad(this.camera.fov / 2)))) * pictureHeight;
  }

  /** Distance to the point, and to the surface before it. */
  #reach(): { gap: number; distance: number } {
    const away = this.camera.position.clone().sub(this.#pivot);
    const distance = away.length();
    const { radius, center } = this.bounds;
    // From outside: the camera may have been turned into the surface.
    const start = center.distanceTo(this.#pivot) + 2 * radius + distance;
    away.divideScalar(distance);
    this.#ray.set(this.#pivot.clone().addScaledVector(away, start), away.clone().negate());
    this.#ray.far = start;
    const hit = this.#ray.intersectObject(this.scene, true)[0];
    const surface = hit ? start - hit.distance : 0;
    return { gap: distance - surface, distance };
  }

  #settle(): void {
    const { camera, bounds } = this;
    camera.lookAt(this.#pivot);
    const { gap } = this.#reach();
    const middle = camera.position.distanceTo(bounds.center);
    camera.near = Math.max(kNearPart * Math.min(gap, Math.max(middle - bounds.radius, gap * kNearPart)), 1e-5 * middle);
    camera.far = middle + 2 * bounds.radius;
    camera.updateProjectionMatrix();
    camera.updateMatrixWorld();
  }
}

/** The sphere around all that is shown. */
export function boundsOf(objects: readonly Object3D[], spheres: readonly Sphere[]): Sphere {
  const all = new Sphere();
  objects.forEach((object, i) => {
    const sphere = spheres[i]!.clone().applyMatrix4(object.matrixWorld);
    if (i === 0) all.copy(sphere);
    else all.union(sphere);
  });
  return all;
}
