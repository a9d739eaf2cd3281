// Sliders: the edge between two pictures follows the pointer, or the arrow keys. Loops stop and go at a click.
"use strict";
for (const slider of document.querySelectorAll(".slider")) {
  const stage = slider.querySelector(".stage");
  const pictures = [...stage.querySelectorAll("img")];
  const [left, right] = slider.querySelectorAll("select");
  left.value = "0";
  right.value = String(pictures.length - 1);
  const show = () => {
    const at = stage.getAttribute("aria-valuenow");
    stage.style.setProperty("--at", at + "%");
    pictures.forEach((picture, i) => {
      const isLeft = String(i) === left.value, isRight = String(i) === right.value;
      picture.classList.toggle("shown", isLeft || isRight);
      const from = isRight && !isLeft ? at : 0, to = isLeft && !isRight ? 100 - at : 0;
      picture.style.clipPath = `inset(0 ${to}% 0 ${from}%)`;
    });
  };
  const move = (percent) => {
    stage.setAttribute("aria-valuenow", Math.round(10 * Math.min(100, Math.max(0, percent))) / 10);
    show();
  };
  const follow = (event) => {
    const box = stage.getBoundingClientRect();
    move((100 * (event.clientX - box.left)) / box.width);
  };
  stage.addEventListener("pointerdown", (event) => {
    stage.setPointerCapture(event.pointerId);
    follow(event);
  });
  stage.addEventListener("pointermove", (event) => {
    if (stage.hasPointerCapture(event.pointerId)) follow(event);
  });
  stage.addEventListener("keydown", (event) => {
    const step = { ArrowLeft: -2, ArrowRight: 2 }[event.key];
    if (!step) return;
    event.preventDefault();
    move(Number(stage.getAttribute("aria-valuenow")) + step);
  });
  left.addEventListener("change", show);
  right.addEventListener("change", show);
  show();
}
for (const loop of document.querySelectorAll(".loop"))
  loop.addEventListener("click", () => loop.classList.toggle("paused"));
