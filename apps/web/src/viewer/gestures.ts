// Pointer, touch, wheel and keys of the picture: what they ask for, not what it does.

/** Zoom a step of the wheel or a key, degrees an arrow key. */
const kWheelZoom = 0.9;
const kKeyDegrees = 3;
/** Lines or pages, in pixels of a wheel. */
const kWheelPixels = [1, 33, 400];
const kPixelsAStep = 100;

export interface Gestures {
  drag(x: number, y: number): void;
  turn(right: number, down: number): void;
  zoom(factor: number): void;
  moveDivider(steps: number): void;
  /** Side 0 is left. */
  choose(side: 0 | 1, method: number): void;
  home(): void;
  togglePanel(): void;
}

function listenToPointers(element: HTMLElement, to: Gestures): void {
  const down = new Map<number, { x: number; y: number }>();
  const middle = () => {
    const all = [...down.values()];
    const x = all.reduce((sum, p) => sum + p.x, 0) / all.length;
    const y = all.reduce((sum, p) => sum + p.y, 0) / all.length;
    return { x, y, spread: Math.hypot(all[0]!.x - x, all[0]!.y - y) };
  };
  element.addEventListener('pointerdown', event => {
    element.setPointerCapture(event.pointerId);
    element.focus({ preventScroll: true });
    down.set(event.pointerId, { x: event.clientX, y: event.clientY });
  });
  element.addEventListener('pointermove', event => {
    if (!down.has(event.pointerId)) return;
    const before = middle();
    down.set(event.pointerId, { x: event.clientX, y: event.clientY });
    const after = middle();
    to.drag(after.x - before.x, after.y - before.y);
    if (before.spread > 0 && after.spread > 0) to.zoom(before.spread / after.spread);
  });
  for (const name of ['pointerup', 'pointercancel'] as const)
    element.addEventListener(name, event => down.delete(event.pointerId));
}

const kKeys: Record<string, (to: Gestures) => void> = {
  ArrowLeft: to => to.turn(-kKeyDegrees, 0),
  ArrowRight: to => to.turn(kKeyDegrees, 0),
  ArrowUp: to => to.turn(0, -kKeyDegrees),
  ArrowDown: to => to.turn(0, kKeyDegrees),
  '+': to => to.zoom(kWheelZoom),
  '=': to => to.zoom(kWheelZoom),
  '-': to => to.zoom(1 / kWheelZoom),
  ',': to => to.moveDivider(-1),
  '.': to => to.moveDivider(1),
  h: to => to.home(),
  p: to => to.togglePanel(),
};

function listenToKeys(to: Gestures): void {
  window.addEventListener('keydown', event => {
    const inForm = event.target instanceof HTMLInputElement || event.target instanceof HTMLSelectElement;
    if (inForm || event.ctrlKey || event.metaKey || event.altKey) return;
    // By place: shifted digits are other signs on every keyboard.
    const digit = /^(?:Digit|Numpad)([123])$/.exec(event.code);
    if (digit) to.choose(event.shiftKey ? 1 : 0, Number(digit[1]) - 1);
    else if (kKeys[event.key]) kKeys[event.key]!(to);
    else return;
    event.preventDefault();
  });
}

export function listen(element: HTMLElement, to: Gestures): void {
  listenToPointers(element, to);
  element.addEventListener(
    'wheel',
    event => {
      to.zoom(kWheelZoom ** ((-event.deltaY * kWheelPixels[event.deltaMode]!) / kPixelsAStep));
      event.preventDefault();
    },
    { passive: false },
  );
  listenToKeys(to);
}
