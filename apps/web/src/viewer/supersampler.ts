// Many samples a pixel, one jittered frame after the other, and their mean: what a map is to be compared with.
import {
  CustomBlending,
  HalfFloatType,
  Mesh,
  NearestFilter,
  NoBlending,
  OneMinusSrcAlphaFactor,
  OrthographicCamera,
  PlaneGeometry,
  ShaderMaterial,
  SrcAlphaFactor,
  WebGLRenderTarget,
  type PerspectiveCamera,
  type Scene,
  type WebGLRenderer,
} from 'three';

/** A frame of supersampling has as many; a picture that rests is refined up to the second number. */
export const kSamples = 16;
export const kMostSamples = 64;

/** Bits in reverse: van der Corput's sequence. */
function radicalInverse(i: number): number {
  let result = 0;
  for (let place = 0.5; i > 0; i >>= 1, place /= 2) result += (i & 1) * place;
  return result;
}

/** The second dimension of Sobol's sequence: with the first, any 16 from the start fill 4 x 4 strata. */
function sobol(i: number): number {
  let result = 0;
  for (let direction = 1 << 30, bits = i; bits > 0; bits >>= 1, direction ^= direction >>> 1)
    if (bits & 1) result ^= direction;
  return result / 2 ** 31;
}

const kQuadText = `
out vec2 seen_uv;
void main() {
  seen_uv = uv;
  gl_Position = vec4(position.xy, 0.0, 1.0);
}`;
const kAddText = `
uniform sampler2D picture;
uniform float part;
in vec2 seen_uv;
void main() { gl_FragColor = vec4(texture(picture, seen_uv).rgb, part); }`;
const kShowText = `
uniform sampler2D picture;
in vec2 seen_uv;
void main() {
  gl_FragColor = vec4(texture(picture, seen_uv).rgb, 1.0);
#include <colorspace_fragment>
}`;

function quadMaterial(fragmentShader: string, adds: boolean): ShaderMaterial {
  return new ShaderMaterial({
    vertexShader: kQuadText,
    fragmentShader,
    uniforms: { picture: { value: null }, part: { value: 1 } },
    depthTest: false,
    depthWrite: false,
    transparent: adds,
    blending: adds ? CustomBlending : NoBlending,
    blendSrc: SrcAlphaFactor,
    blendDst: OneMinusSrcAlphaFactor,
  });
}

/** A rectangle of device pixels, from the left and from below. */
export interface Region {
  x: number;
  y: number;
  width: number;
  height: number;
}

export class Supersampler {
  samples = 0;
  readonly #one = new WebGLRenderTarget(1, 1, {
    type: HalfFloatType,
    minFilter: NearestFilter,
    magFilter: NearestFilter,
  });
  readonly #mean = new WebGLRenderTarget(1, 1, {
    type: HalfFloatType,
    minFilter: NearestFilter,
    magFilter: NearestFilter,
    depthBuffer: false,
  });
  readonly #add = quadMaterial(kAddText, true);
  readonly #show = quadMaterial(kShowText, false);
  readonly #quad = new Mesh(new PlaneGeometry(2, 2), this.#add);
  readonly #camera = new OrthographicCamera(-1, 1, 1, -1, 0, 1);

  constructor(readonly renderer: WebGLRenderer) {
    this.#quad.frustumCulled = false;
  }

  /** What was added is of another picture. */
  restart(): void {
    this.samples = 0;
  }

  /** Adds one sample of each pixel in `region` of a picture of `width` x `height` device pixels. */
  add(scene: Scene, camera: PerspectiveCamera, width: number, height: number, region: Region): void {
    for (const target of [this.#one, this.#mean]) {
      if (target.width !== width || target.height !== height) target.setSize(width, height);
      target.scissorTest = true;
      target.scissor.set(region.x, region.y, region.width, region.height);
    }
    const { renderer } = this;
    const before = renderer.autoClear;
    const i = this.samples++;
    camera.setViewOffset(width, height, radicalInverse(i) - 0.5, sobol(i) - 0.5, width, height);
    renderer.autoClear = true;
    renderer.setRenderTarget(this.#one);
    renderer.render(scene, camera);
    camera.clearViewOffset();
    renderer.autoClear = false;
    this.#draw(this.#add, this.#one, this.#mean, 1 / this.samples);
    renderer.autoClear = before;
  }

  /** Draws the mean so far where the renderer draws now. */
  show(): void {
    this.#draw(this.#show, this.#mean, null, 1);
  }

  #draw(material: ShaderMaterial, from: WebGLRenderTarget, to: WebGLRenderTarget | null, part: number): void {
    material.uniforms['picture']!.value = from.texture;
    material.uniforms['part']!.value = part;
    this.#quad.material = material;
    this.renderer.setRenderTarget(to);
    this.renderer.render(this.#quad, this.#camera);
    this.renderer.setRenderTarget(null);
  }
}
