#include "app/report/page.h"

namespace pl {

const char* const kPageStyle = R"css(
body { font: 16px/1.45 sans-serif; max-width: 1180px; margin: 2em auto; padding: 0 1em; color: #222; background: #fff; }
h1, h2 { line-height: 1.2; }
h2 { margin-top: 2.2em; border-bottom: 1px solid #ccc; }
.headline { font-size: 1.25em; margin: 0.5em 0; padding-left: 0.6em; border-left: 5px solid #888; }
.note { color: #666; font-size: 0.9em; }
.warning { background: #fff3cd; padding: 0.5em 0.8em; }
table { border-collapse: collapse; margin: 0.8em 0; }
th, td { padding: 0.25em 0.7em; border-bottom: 1px solid #ddd; text-align: right; }
th:first-child, td:first-child, th:nth-child(2), td:nth-child(2) { text-align: left; }
pre { background: #f4f4f4; padding: 0.6em; overflow-x: auto; }
svg { max-width: 100%; height: auto; }
.pictures { outline: none; }
.pictures:focus { box-shadow: 0 0 0 2px #99c; }
.bar { display: flex; gap: 1em; align-items: center; flex-wrap: wrap; }
.bar input[type=range] { flex: 1; min-width: 14em; }
.bar output { min-width: 9em; font-weight: bold; }
.grid { display: flex; flex-wrap: wrap; gap: 12px; margin-top: 0.6em; }
figure { margin: 0; width: 270px; border-top: 5px solid #888; cursor: pointer; }
figure .frame { width: 100%; background: #ddd; min-height: 60px; }
figure img { width: 100%; display: block; image-rendering: pixelated; }
figure.large { width: 100%; max-width: 800px; }
.grid.single figure:not(.large) { display: none; }
figcaption { font-size: 0.88em; }
)css";

const char* const kPageScript = R"js(
'use strict';
const scenes = JSON.parse(document.getElementById('pictures').textContent);
const number = v => v === null ? 'unknown' : Number(v).toPrecision(3);

/// The last picture that was there at a time; none before the set-up was over.
function atTime(points, seconds) {
  let found = null;
  for (const p of points) if (p.seconds <= seconds) found = p;
  return found;
}

/// The first picture from which on the error stays at or below a target.
function atError(points, error) {
  let found = null;
  for (let i = points.length - 1; i >= 0 && points[i].relmse <= error; --i) found = points[i];
  return found;
}

function makeViewer(root, data) {
  const all = data.cells.flatMap(c => c.points);
  const range = key => {
    const values = all.map(p => p[key]).filter(v => v > 0);
    return [Math.min(...values), Math.max(...values)];
  };
  const slider = root.querySelector('input[type=range]');
  const output = root.querySelector('output');
  const grid = root.querySelector('.grid');
  let mode = 'time';
  const value = () => {
    const [low, high] = range(mode === 'time' ? 'seconds' : 'relmse');
    const share = slider.value / slider.max;
    return mode === 'time' ? low * Math.pow(high / low, share) : high * Math.pow(low / high, share);
  };
  const figures = data.cells.map(cell => addFigure(cell.title, cell.color));
  if (data.reference) {
    const figure = addFigure('reference', '#000');
    figure.img.src = data.reference;
    figure.img.hidden = false;
    figure.caption.textContent = 'reference';
  }
  function addFigure(title, color) {
    const figure = document.createElement('figure');
    figure.style.borderTopColor = color;
    const frame = document.createElement('div');
    frame.className = 'frame';
    const img = document.createElement('img');
    img.hidden = true;
    img.alt = title;
    const caption = document.createElement('figcaption');
    frame.append(img);
    figure.append(frame, caption);
    figure.addEventListener('click', () => enlarge(figure.classList.contains('large') ? null : figure));
    grid.append(figure);
    return { figure, img, caption };
  }
  function enlarge(figure) {
    for (const other of grid.children) other.classList.toggle('large', other === figure);
    grid.classList.toggle('single', figure !== null);
  }
  function update() {
    const v = value() * (1 + 1e-9);
    output.textContent = mode === 'time' ? number(v) + ' s' : 'relMSE ' + number(v);
    data.cells.forEach((cell, i) => {
      const p = mode === 'time' ? atTime(cell.points, v) : atError(cell.points, v);
      const { img, caption } = figures[i];
      img.hidden = !p;
      if (p) img.src = p.picture;
      const first = cell.points[0], last = cell.points[cell.points.length - 1];
      caption.textContent = cell.title + ': ' +
        (p ? p.spp + ' spp, ' + number(p.seconds) + ' s, relMSE ' + number(p.relmse)
           : !first ? 'no pictures'
           : mode === 'time' ? 'first picture after ' + number(first.seconds) + ' s'
           : 'not reached after ' + number(last.seconds) + ' s');
    });
  }
  function setMode(next) {
    mode = next;
    for (const radio of root.querySelectorAll('input[type=radio]')) radio.checked = radio.value === mode;
    update();
  }
  slider.addEventListener('input', update);
  for (const radio of root.querySelectorAll('input[type=radio]'))
    radio.addEventListener('change', () => setMode(radio.value));
  root.addEventListener('keydown', event => {
    const step = { ArrowLeft: -25, ArrowRight: 25 }[event.key];
    if (step && event.target !== slider) {
      slider.value = Number(slider.value) + step;
      update();
    } else if (event.key === 'm') {
      setMode(mode === 'time' ? 'error' : 'time');
    } else if (event.key === '0') {
      enlarge(data.reference ? grid.lastElementChild : null);
    } else if (event.key >= '1' && event.key <= '9') {
      if (figures[event.key - 1]) enlarge(figures[event.key - 1].figure);
    } else if (event.key === 'Escape') {
      enlarge(null);
    } else {
      return;
    }
    event.preventDefault();
  });
  update();
}

scenes.forEach((data, i) => makeViewer(document.getElementById('viewer-' + i), data));
)js";

}  // namespace pl
