'use strict';
(() => {
  const run = JSON.parse(document.getElementById('run').textContent);
  const video = document.querySelector('video');
  const times = run.frames, last = times.length - 1;

  // --- theme: the system's, until the reader chooses
  const root = document.documentElement;
  const dark = window.matchMedia('(prefers-color-scheme: dark)');
  const setTheme = name => { root.dataset.theme = name; };
  dark.addEventListener('change', e => setTheme(e.matches ? 'dark' : 'light'));
  document.getElementById('theme').addEventListener('click',
    () => setTheme(root.dataset.theme === 'dark' ? 'light' : 'dark'));

  // --- values at any time, straight lines between the rows of the history
  const h = run.history;
  const rowAfter = t => {  // index of the first row later than t
    let low = 0, high = h.time.length;
    while (low < high) { const mid = (low + high) >> 1; if (h.time[mid] > t) high = mid; else low = mid + 1; }
    return low;
  };
  const at = (column, t) => {
    const k = rowAfter(t);
    if (k === 0) return column[0];
    if (k === column.length) return column[k - 1];
    const share = (t - h.time[k - 1]) / (h.time[k] - h.time[k - 1]);
    return column[k - 1] + share * (column[k] - column[k - 1]);
  };
  const brokenAt = t => { const k = rowAfter(t); return k === 0 ? 0 : h.broken[k - 1]; };
  const words = (value, scale) => {
    const number = (value * scale.factor).toFixed(scale.decimals);
    return (Number(number) === 0 ? number.replace('-', '') : number.replace('-', '\u2212')) + '\u00a0' + scale.unit;
  };

  // --- the moment that is shown: simulated time, from which everything else follows
  let now = run.poster ?? (times.length ? times[0] : h.time[0]);
  const readout = document.getElementById('readout');
  const keys = [...document.querySelectorAll('[data-time]')];
  const cursors = [...document.querySelectorAll('.cursor')].map((svg, k) => ({
    svg, place: run.charts[k], line: svg.querySelector('line'), dot: svg.querySelector('circle') }));

  const along = (range, logarithmic, v) => logarithmic
    ? Math.log(v / range[0]) / Math.log(range[1] / range[0]) : (v - range[0]) / (range[1] - range[0]);
  const pointOf = (p, t) => {
    const x = p.of_time ? t : at(h.displacement, t), y = p.of_time ? null : at(h.load, t);
    return [p.axes[0] + p.axes[2] * along(p.x, p.x_logarithmic, x),
            y === null ? null : p.axes[1] + p.axes[3] * (1 - along(p.y, p.y_logarithmic, y))];
  };

  const show = t => {
    now = t;
    let text = 't = ' + words(t, run.scales.time);
    if (h.load) text += ' \u00b7 ' + words(at(h.load, t), run.scales.load);
    if (run.breaks) text += ' \u00b7 ' + brokenAt(t) + ' broken';
    readout.textContent = text;
    for (const { svg, place, line, dot } of cursors) {
      const [x, y] = pointOf(place, Math.min(t, place.until));
      line.setAttribute('x1', x); line.setAttribute('x2', x);
      if (dot) { dot.setAttribute('cx', x); dot.setAttribute('cy', y); }
      svg.setAttribute('aria-valuetext', text);
      svg.setAttribute('aria-valuenow', t);
    }
    let current = null;
    for (const key of keys)
      if (key.classList.contains('key') && Number(key.dataset.time) <= t * (1 + 1e-12) + 1e-300) current = key;
    for (const key of keys) if (key.classList.contains('key')) key.setAttribute('aria-current', key === current);
  };

  // --- film: frame k shows the simulated time times[k]
  const frameNow = () => Math.min(last, Math.max(0, Math.floor(video.currentTime * run.fps + 1e-3)));
  const frameAt = t => {
    let low = 0, high = last;
    while (low < high) { const mid = (low + high) >> 1; if (times[mid] >= t * (1 - 1e-12)) high = mid; else low = mid + 1; }
    return low;
  };
  // The middle of a frame: its border could be rounded into the one before.
  const toFrame = k => { video.currentTime = (Math.min(last, Math.max(0, k)) + 0.5) / run.fps; };
  const go = t => {
    const k = video ? frameAt(t) : -1;
    if (video) toFrame(k);
    show(video ? times[k] : t);
  };
  if (video) {
    // A browser shows the poster until the film has played or moved for the first time.
    const showsPoster = () => video.poster && video.paused && video.currentTime === 0;
    // The middle of a frame again: a seek that has not arrived must not move the cursor back.
    const follow = () => { if (!video.seeking && !showsPoster()) show(times[frameNow()]); };
    const tick = () => { follow(); video.requestVideoFrameCallback(tick); };
    if ('requestVideoFrameCallback' in video) video.requestVideoFrameCallback(tick);
    for (const event of ['timeupdate', 'seeked', 'ended']) video.addEventListener(event, follow);
    const play = document.getElementById('play');
    const toggle = () => { if (video.paused) video.play(); else video.pause(); };
    play.addEventListener('click', toggle);
    for (const event of ['play', 'pause'])
      video.addEventListener(event, () => { play.textContent = video.paused ? 'Play' : 'Pause'; });
    document.addEventListener('keydown', e => {
      if (e.ctrlKey || e.metaKey || e.altKey || e.target.closest('input, select, textarea, summary')) return;
      const onButton = e.target.closest('button');
      const step = n => { video.pause(); const k = Math.min(last, Math.max(0, frameNow() + n)); toFrame(k); show(times[k]); };
      const actions = {
        ' ': () => { if (onButton) return false; toggle(); },
        'ArrowRight': () => step(e.shiftKey ? run.fps : 1), 'ArrowLeft': () => step(e.shiftKey ? -run.fps : -1),
        '.': () => step(1), ',': () => step(-1), 'Home': () => step(-last), 'End': () => step(last) };
      if (actions[e.key] && actions[e.key]() !== false) e.preventDefault();
    });
  }
  if (!video) {  // the curves alone: a hundredth of the run at a time
    const first = h.time[0], end = h.time[h.time.length - 1];
    document.addEventListener('keydown', e => {
      const to = { ArrowRight: now + (end - first) / 100, ArrowLeft: now - (end - first) / 100, Home: first, End: end }[e.key];
      if (to === undefined || e.ctrlKey || e.metaKey || e.altKey) return;
      go(Math.min(end, Math.max(first, to)));
      e.preventDefault();
    });
  }
  for (const key of keys)
    key.addEventListener('click', () => { if (video) video.pause(); go(Number(key.dataset.time)); });

  // --- cursors: a click or a drag on a curve moves the film
  for (const { svg, place } of cursors) {
    const timeAt = e => {
      const box = svg.getBoundingClientRect(), view = svg.viewBox.baseVal;
      const x = (e.clientX - box.left) / box.width * view.width, y = (e.clientY - box.top) / box.height * view.height;
      if (place.of_time) {
        const share = Math.min(1, Math.max(0, (x - place.axes[0]) / place.axes[2]));
        return Math.min(place.until, place.x[0] + share * (place.x[1] - place.x[0]));
      }
      let best = 0, least = Infinity;
      for (let k = 0; k < h.time.length && h.time[k] <= place.until; ++k) {
        const [px, py] = pointOf(place, h.time[k]), far = (px - x) ** 2 + (py - y) ** 2;
        if (far < least) { least = far; best = h.time[k]; }
      }
      return best;
    };
    svg.addEventListener('pointerdown', e => {
      if (video) video.pause();
      svg.setPointerCapture(e.pointerId);
      go(timeAt(e));
    });
    svg.addEventListener('pointermove', e => { if (e.buttons & 1) go(timeAt(e)); });
  }

  document.getElementById('copy').addEventListener('click', async e => {
    const text = document.getElementById('command').textContent;
    try { await navigator.clipboard.writeText(text); } catch {  // a page from disk may not be allowed to
      const area = document.createElement('textarea');
      area.value = text; document.body.append(area); area.select();
      document.execCommand('copy'); area.remove();
    }
    e.target.textContent = 'Copied';
    setTimeout(() => { e.target.textContent = 'Copy'; }, 1500);
  });
  show(now);
})();
