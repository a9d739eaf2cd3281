// The viewer: a scene by two methods side by side, split by a line that can be dragged.
import './style.css';
import { Divider } from './divider.js';
import { listen } from './gestures.js';
import { OrbitView } from './orbit_view.js';
import { layOutPanel } from './panel.js';
import { loadScene } from './scene_description.js';
import { kMethods, Stage, type Drawn, type Method } from './stage.js';

const find = <T extends HTMLElement>(selector: string) => document.querySelector<T>(selector)!;
const kMostPixelRatio = 2;

function showError(error: unknown): void {
  const message = error instanceof Error ? error.message : String(error);
  find('#message').textContent = message;
  document.body.dataset['state'] = 'error';
}

class Viewer {
  #changed = true;
  readonly #picture = find('#picture');
  readonly #methods: [Method, Method] = ['map', 'original'];
  readonly #sides = [find<HTMLElement>('#left'), find<HTMLElement>('#right')] as const;
  readonly #divider = new Divider(find('#divider'), () => this.change());
  readonly #view: OrbitView;

  constructor(readonly stage: Stage) {
    this.#view = new OrbitView(stage.camera, stage.description.camera, stage.scene, stage.bounds);
    this.#sides.forEach((side, i) => this.#fillMethods(side.querySelector('select')!, i as 0 | 1));
    const panel = find('#panel');
    layOutPanel(panel, stage, () => this.change());
    const toggle = find<HTMLButtonElement>('#toggle');
    const togglePanel = () => {
      panel.hidden = !panel.hidden;
      toggle.setAttribute('aria-expanded', String(!panel.hidden));
    };
    toggle.addEventListener('click', togglePanel);
    if (window.matchMedia('(max-width: 700px)').matches) togglePanel();
    const moved = (move: () => void) => () => (move(), this.change());
    listen(this.#picture, {
      drag: (x, y) => moved(() => this.#view.drag(x, y, this.#picture.clientHeight))(),
      turn: (right, down) => moved(() => this.#view.turn(right, down))(),
      zoom: factor => moved(() => this.#view.zoom(factor))(),
      home: moved(() => this.#view.home()),
      moveDivider: steps => this.#divider.step(steps),
      choose: (side, method) => this.#choose(side, kMethods[method]!.method),
      togglePanel,
    });
    new ResizeObserver(() => this.#resize()).observe(this.#picture);
    this.#resize();
    this.#draw();
    performance.mark('redmap-first-picture');
    document.body.dataset['state'] = 'shown';
    const step = () => {
      if (this.#changed || stage.isUnfinished(this.#methods)) this.#draw();
      requestAnimationFrame(step);
    };
    requestAnimationFrame(step);
  }

  /** The picture is another from now on. */
  change(): void {
    this.#changed = true;
  }

  #fillMethods(select: HTMLSelectElement, side: 0 | 1): void {
    select.replaceChildren(...kMethods.map(({ method, label }) => new Option(label, method)));
    select.value = this.#methods[side];
    select.addEventListener('change', () => this.#choose(side, select.value as Method));
  }

  #choose(side: 0 | 1, method: Method): void {
    this.#methods[side] = method;
    this.#sides[side].querySelector('select')!.value = method;
    this.change();
  }

  #resize(): void {
    const { clientWidth, clientHeight } = this.#picture;
    this.stage.resize(Math.max(1, clientWidth), Math.max(1, clientHeight), Math.min(devicePixelRatio, kMostPixelRatio));
    this.change();
    // Before the browser shows it: a resized canvas is empty.
    if (document.body.dataset['state'] === 'shown') this.#draw();
  }

  #draw(): void {
    if (this.#changed) this.stage.restart();
    this.#changed = false;
    const drawn = this.stage.draw(this.#methods, this.#divider.part);
    drawn.forEach((each, i) => this.#describe(i as 0 | 1, each));
    const pixels = Math.max(1, Math.round(this.#view.heightPixels(this.#picture.clientHeight)));
    find('#height').textContent = `${pixels} pixel${pixels === 1 ? '' : 's'} high`;
  }

  #describe(side: 0 | 1, { milliseconds, samples }: Drawn): void {
    const element = this.#sides[side];
    const time = milliseconds > 0 ? `${milliseconds.toFixed(milliseconds < 10 ? 1 : 0)} ms` : '';
    element.querySelector('.time')!.textContent = time;
    element.dataset['samples'] = String(samples);
    const isStale = this.#methods[side] === 'map' && this.stage.objects.some(({ material }) => material.isStale);
    element.querySelector<HTMLElement>('.stale')!.hidden = !isStale;
  }
}

async function start(): Promise<void> {
  const description = await loadScene(new URLSearchParams(location.search));
  const stage = new Stage(find<HTMLCanvasElement>('canvas'), description);
  await stage.load(part => (find<HTMLProgressElement>('progress').value = part));
  const name = description.name || stage.objects[0]!.name;
  document.title = `${name} – redmap`;
  find('h1').textContent = name.replaceAll('_', ' ');
  new Viewer(stage);
}

start().catch(showError);
window.addEventListener('error', event => showError(event.error ?? event.message));
