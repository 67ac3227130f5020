'use strict';
(() => {
const all = (s, e = document) => [...e.querySelectorAll(s)];
const make = (tag, words) => { const e = document.createElement(tag); if (words) e.textContent = words; return e; };
const tip = document.getElementById('tip');
let pinned = null;

// What a point says: the row of its interval, its own words, or its place on the axes.
const rowOf = key => document.querySelector(`tr[data-k="${CSS.escape(key)}"]`);
function words(mark) {
  if (mark.dataset.t) return mark.dataset.t;
  const group = mark.closest('[data-t]');
  if (group) return group.dataset.t;
  const lines = [];
  const panel = mark.closest('.panel');
  const series = mark.closest('[data-s]');
  if (panel && mark.hasAttribute('cx')) {
    const [xl, yl] = panel.dataset.n.split('|');
    const a = axes(panel);
    const x = a.x.value(+mark.getAttribute('cx')), y = a.y.value(+mark.getAttribute('cy'));
    const name = series && series.dataset.s;
    if (name) lines.push(name);
    if (!a.x.names) lines.push(`${xl}: ${short(x)}`);
    if (!a.y.names) lines.push(`${yl}: ${short(y)}`);
  }
  const row = mark.dataset.k && rowOf(mark.dataset.k);
  if (row) {
    const heads = all('th', row.closest('table'));
    all('td', row).forEach((cell, k) => { if (cell.textContent) lines.push(`${heads[k].textContent}: ${cell.textContent}`); });
  }
  return lines.join('\n').trim();
}
const short = v => Math.abs(v) >= 1e5 || (v && Math.abs(v) < 1e-3) ? v.toExponential(2) : String(+v.toPrecision(4));
function show(mark, x, y) {
  const text = words(mark);
  if (!text) return;
  tip.textContent = text;
  tip.hidden = false;
  const w = tip.offsetWidth, h = tip.offsetHeight;
  tip.style.left = Math.max(4, Math.min(x + 14, innerWidth - w - 4)) + 'px';
  tip.style.top = Math.max(4, y + 14 + h > innerHeight ? y - h - 10 : y + 14) + 'px';
  light(mark.dataset.k);
}
function light(key) {
  all('.hot').forEach(e => e.classList.remove('hot'));
  if (key) all(`[data-k="${CSS.escape(key)}"]`).forEach(e => e.classList.add('hot'));
}
function hide() { tip.hidden = true; light(pinned); }
const MARK = '.dot, .dot circle, circle.ring, [data-k], [data-t]';
document.addEventListener('pointermove', e => {
  const mark = e.target.closest && e.target.closest(MARK);
  if (mark) show(mark, e.clientX, e.clientY); else hide();
});
document.addEventListener('click', e => {
  const mark = e.target.closest && e.target.closest('[data-k]');
  pinned = mark && mark.dataset.k !== pinned ? mark.dataset.k : null;
  light(pinned);
});
document.addEventListener('keydown', e => { if (e.key === 'Escape') { pinned = null; hide(); } });

// Axes as the page has them: ends, logarithm, words; the box in dots.
function axes(panel) {
  const [left, top, width, height] = panel.dataset.b.split(' ').map(Number);
  const axis = (text, at, length, sign) => {
    const [from, to, log, names] = text.split(' ').map(Number);
    return { from, to, log, names, value: p => {
      const share = (p - at) / length;
      const v = from + (sign > 0 ? share : 1 - share) * (to - from);
      return log ? 10 ** v : v;
    } };
  };
  return { left, top, width, height, x: axis(panel.dataset.x, left, width, 1), y: axis(panel.dataset.y, top, height, -1) };
}

// Zoom over x: marks keep their own place in data-x0; lines are stretched.
function zoom(figure, from, to) {
  const panels = all('.panel', figure);
  panels.forEach((panel, k) => {
    const a = axes(panel), f = (to - from) / (a.x.to - a.x.from);
    const s = 1 / f, start = a.left + a.width * (from - a.x.from) / (a.x.to - a.x.from);
    const data = panel.querySelector('.data');
    if (!data.hasAttribute('clip-path')) {
      const id = 'clip' + Math.random().toString(36).slice(2);
      const clip = document.createElementNS(panel.namespaceURI, 'clipPath'); clip.id = id;
      const box = document.createElementNS(panel.namespaceURI, 'rect');
      Object.entries({ x: a.left, y: a.top - 4, width: a.width, height: a.height + 8 }).forEach(([n, v]) => box.setAttribute(n, v));
      clip.append(box); panel.prepend(clip); data.setAttribute('clip-path', `url(#${id})`);
    }
    all('circle', data).forEach(c => {
      if (!c.dataset.x0) c.dataset.x0 = c.getAttribute('cx');
      c.setAttribute('cx', a.left + (c.dataset.x0 - start) * s);
    });
    all('path', data).forEach(p => {
      p.setAttribute('transform', `translate(${a.left - start * s} 0) scale(${s} 1)`);
      p.setAttribute('vector-effect', 'non-scaling-stroke');
    });
    const step = nice((to - from) / 5, a.x.log), marks = [];
    for (let v = Math.ceil(from / step) * step; v <= to; v += step) marks.push(v);
    const at = v => a.left + a.width * (v - from) / (to - from);
    panel.querySelector('.xg').replaceChildren();
    marks.forEach(v => {
      const line = document.createElementNS(panel.namespaceURI, 'path');
      line.setAttribute('class', 'grid'); line.setAttribute('d', `M${at(v)} ${a.top}V${a.top + a.height}`);
      panel.querySelector('.xg').append(line);
    });
    const numbers = figure.querySelector('.xn');
    if (k === 0 && numbers) {
      const first = numbers.querySelector('text'), y = first ? first.getAttribute('y') : 0;
      if (!numbers.kept) numbers.kept = [...numbers.children];
      const whole = from === a.x.from && to === a.x.to;
      numbers.replaceChildren(...(whole ? numbers.kept : marks.map(v => {
        const t = document.createElementNS(panel.namespaceURI, 'text');
        t.setAttribute('x', at(v)); t.setAttribute('y', y); t.setAttribute('text-anchor', 'middle');
        t.textContent = short(a.x.log ? 10 ** v : +v.toFixed(9));
        return t;
      })));
    }
  });
  figure.zoomed = [from, to];
}
const nice = (v, log) => { const d = 10 ** Math.floor(Math.log10(v)); const s = [1, 2, 5, 10].find(f => f * d >= v) * d; return log ? Math.max(s, 0.1) : s; };

all('figure').forEach(figure => {
  const svg = figure.querySelector('svg'), panel = figure.querySelector('.panel');
  const bar = make('div');
  // Series on and off.
  const names = [...new Set(all('[data-s]', figure).map(e => e.dataset.s).filter(n => n))];
  if (names.length > 1) names.forEach(name => {
    const b = make('button', name.length > 24 ? name.slice(0, 23) + '…' : name);
    b.type = 'button'; b.setAttribute('aria-pressed', 'true');
    b.addEventListener('click', () => {
      const on = b.getAttribute('aria-pressed') === 'false';
      b.setAttribute('aria-pressed', on);
      all('[data-s]', figure).filter(e => e.dataset.s === name).forEach(e => e.classList.toggle('off', !on));
    });
    bar.append(b);
  });
  if (panel && !axes(panel).x.names) {
    const a = axes(panel), whole = [a.x.from, a.x.to];
    const scale = by => {
      const [f, t] = figure.zoomed || whole, m = (f + t) / 2, h = (t - f) / 2 * by;
      zoom(figure, Math.max(whole[0], m - h), Math.min(whole[1], m + h));
    };
    const move = by => {
      const [f, t] = figure.zoomed || whole, d = Math.max(whole[0] - f, Math.min(whole[1] - t, by * (t - f)));
      zoom(figure, f + d, t + d);
    };
    const button = (w, label, f) => { const b = make('button', w); b.type = 'button'; b.setAttribute('aria-label', label); b.addEventListener('click', f); bar.append(b); };
    button('+', 'zoom in', () => scale(.5));
    button('−', 'zoom out', () => scale(2));
    button('←', 'earlier', () => move(-.5));
    button('→', 'later', () => move(.5));
    button('all', 'show all', () => zoom(figure, ...whole));
    // A stretch drawn with the mouse is zoomed to.
    let begin = null;
    const place = e => {
      const r = svg.getBoundingClientRect(), [f, t] = figure.zoomed || whole;
      return f + (t - f) * Math.max(0, Math.min(1, ((e.clientX - r.left) / r.width * 420 - a.left) / a.width));
    };
    svg.addEventListener('pointerdown', e => { if (e.pointerType === 'mouse') { begin = place(e); e.preventDefault(); } });
    svg.addEventListener('pointerup', e => {
      if (begin === null) return;
      const end = place(e), [f, t] = [Math.min(begin, end), Math.max(begin, end)];
      begin = null;
      if (t - f > .02 * (whole[1] - whole[0])) zoom(figure, f, t);
    });
    svg.addEventListener('dblclick', () => zoom(figure, ...whole));
  }
  if (figure.querySelector('.sphere')) spheres(figure, bar);
  if (bar.childElementCount) figure.querySelector('figcaption').after(bar);
});

// Spheres turn under the pointer and by buttons.
function spheres(figure, bar) {
  const views = all('.sphere', figure);
  const every = all('[data-p]', figure);
  views.forEach(view => {
    const own = every.filter(e => e.tagName !== 'text').map(e => e.cloneNode(true));
    all('[data-p]', view).forEach(e => e.remove());
    own.forEach(e => view.append(e));
    const names = [...new Set(every.filter(e => e.tagName === 'text'))];
    names.forEach(e => view.append(e.cloneNode(true)));
    view.angles = view.dataset.v.split(' ').map(Number);
    draw(view);
    let last = null;
    view.addEventListener('pointerdown', e => { last = [e.clientX, e.clientY]; view.setPointerCapture(e.pointerId); });
    view.addEventListener('pointermove', e => {
      if (!last) return;
      turn(-(e.clientX - last[0]) / 90, (e.clientY - last[1]) / 90);
      last = [e.clientX, e.clientY];
    });
    ['pointerup', 'pointercancel'].forEach(n => view.addEventListener(n, () => { last = null; }));
  });
  function turn(azimuth, elevation) {
    const [a, b] = views;
    a.angles = [a.angles[0] + azimuth, Math.max(-1.5, Math.min(1.5, a.angles[1] + elevation))];
    b.angles = [a.angles[0] + Math.PI, -a.angles[1]];
    views.forEach(draw);
  }
  [['←', 'turn left', -.3, 0], ['→', 'turn right', .3, 0], ['↑', 'tilt up', 0, .3], ['↓', 'tilt down', 0, -.3]].forEach(([w, l, x, y]) => {
    const b = make('button', w); b.type = 'button'; b.setAttribute('aria-label', l);
    b.addEventListener('click', () => turn(x, y)); bar.append(b);
  });
  function draw(view) {
    const [x, y, r] = view.dataset.b.split(' ').map(Number);
    const [a, e] = view.angles, sa = Math.sin(a), ca = Math.cos(a), se = Math.sin(e), ce = Math.cos(e);
    const look = [[-sa, ca, 0], [-se * ca, -se * sa, ce], [ce * ca, ce * sa, se]];
    const place = v => look.map(l => l[0] * v[0] + l[1] * v[1] + l[2] * v[2]);
    all('path.grid', view).forEach((path, k) => {
      let d = '', pen = false;
      for (let i = 0; i <= 72; i++) {
        const v = [0, 0, 0], w = i * Math.PI / 36;
        v[(k + 1) % 3] = Math.cos(w); v[(k + 2) % 3] = Math.sin(w);
        const [px, py, near] = place(v);
        if (near < 0) { pen = false; continue; }
        d += `${pen ? 'L' : 'M'}${(x + r * px).toFixed(1)} ${(y - r * py).toFixed(1)}`; pen = true;
      }
      path.setAttribute('d', d);
    });
    all('[data-p]', view).forEach(mark => {
      const [px, py, near] = place(mark.dataset.p.split(' ').map(Number));
      mark.classList.toggle('off', near < 0);
      const out = mark.tagName === 'text' ? r + 13 : r;
      mark.setAttribute(mark.tagName === 'text' ? 'x' : 'cx', (x + out * px).toFixed(1));
      mark.setAttribute(mark.tagName === 'text' ? 'y' : 'cy', (y - out * py + (mark.tagName === 'text' ? 4 : 0)).toFixed(1));
    });
  }
}

// What can be copied.
all('pre').forEach(pre => {
  const b = make('button', 'Copy'); b.type = 'button';
  b.addEventListener('click', async () => {
    try { await navigator.clipboard.writeText(pre.textContent); } catch {
      const range = document.createRange(); range.selectNodeContents(pre);
      const s = getSelection(); s.removeAllRanges(); s.addRange(range); document.execCommand('copy');
    }
    b.textContent = 'Copied';
  });
  pre.before(b);
});
addEventListener('beforeprint', () => all('details').forEach(d => { d.open = true; }));
})();
