// The line between the two pictures: dragged by pointer or touch, moved by arrow keys when it has the focus.

const kStep = 0.02;

export class Divider {
  #part = 0.5;

  constructor(
    readonly element: HTMLElement,
    readonly onMove: () => void,
  ) {
    element.addEventListener('pointerdown', event => {
      element.setPointerCapture(event.pointerId);
      event.stopPropagation();
    });
    element.addEventListener('pointermove', event => {
      if (!element.hasPointerCapture(event.pointerId)) return;
      const box = element.parentElement!.getBoundingClientRect();
      this.part = (event.clientX - box.left) / box.width;
    });
    element.addEventListener('keydown', event => {
      if (event.key !== 'ArrowLeft' && event.key !== 'ArrowRight') return;
      this.step(event.key === 'ArrowRight' ? 1 : -1);
      event.stopPropagation();
      event.preventDefault();
    });
    this.part = this.#part;
  }

  step(steps: number): void {
    this.part = this.#part + kStep * steps;
  }

  /** Of the picture's width that the left side has. */
  get part(): number {
    return this.#part;
  }
  set part(part: number) {
    this.#part = Math.min(Math.max(part, 0), 1);
    this.element.style.left = `${100 * this.#part}%`;
    this.element.setAttribute('aria-valuenow', String(Math.round(100 * this.#part)));
    this.onMove();
  }
}
