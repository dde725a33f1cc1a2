// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
//
// The timeline: plays the motion, goes to any time of it, and shows when which parts clash.
import { tellAddress } from './address';
import type { Clash } from './clashes';
import { byId, button, chooser, el } from './dom';
import { counted, plural, rounded } from './format';
import type { Shortcut } from './keys';
import { frameAt, type Motion } from './motion';
import type { Store } from './store';
import { Impacts } from './timeline-impacts';
import { Lanes } from './timeline-lanes';

const kSpeeds = [0.1, 0.25, 0.5, 1, 2, 4];
/** A page that was hidden for a while goes on where it was. */
const kLongestStep = 0.25; // seconds

export class Timeline {
  private readonly first: number;
  private readonly last: number;
  private readonly slider = el('div', {
    id: 'time-slider',
    role: 'slider',
    tabindex: 0,
    'aria-label': 'Time',
    'aria-orientation': 'horizontal',
  });
  private readonly head = el('div', { class: 'playhead', 'aria-hidden': 'true' });
  private readonly field = el('div', { class: 'time-field', 'aria-hidden': 'true' }, this.head);
  private readonly readout = el('span');
  private readonly now = el('span', { class: 'time-now' });
  private readonly playButton = button('', () => this.toggle(), { id: 'play' });
  private readonly repeat = el('input', { type: 'checkbox', id: 'repeat' });
  private readonly lanes: Lanes;
  private readonly impacts: Impacts;
  private speed = 1;
  private isPlaying = false;
  private lastTick = 0;
  private telling: ReturnType<typeof setTimeout> | undefined;

  constructor(
    private readonly motion: Motion,
    private readonly clashes: Clash[],
    private readonly store: Store,
    private readonly visible: () => Clash[],
  ) {
    [this.first, this.last] = [motion.times[0], motion.times[motion.times.length - 1]];
    const host = byId('timeline');
    const tracks = el('div', { id: 'tracks' });
    const shareOf = (time: number) => this.shareOf(time);
    const choose = (clash: Clash) => store.select(clash);
    this.lanes = new Lanes(tracks, shareOf, choose);
    this.impacts = new Impacts(shareOf, choose);
    const scale = el('div', { class: 'scale' }, this.slider, this.impacts.row);
    tracks.append(el('div', { class: 'tracks-body' }, scale, this.lanes.space, this.field));
    host.append(this.makeBar(), tracks);
    host.hidden = false;
    this.slider.setAttribute('aria-valuemin', String(this.first));
    this.slider.setAttribute('aria-valuemax', String(this.last));
    this.makeTicks();
    this.listenToPointer(tracks);
    this.slider.addEventListener('keydown', (event) => this.key(event));
    store.listen((state, changed) => {
      if (changed.has('clash') && state.clash) this.pause();
      if (changed.has('filter') || changed.has('sort')) this.show();
      if (changed.has('clash')) for (const marks of [this.lanes, this.impacts]) marks.choose(state.clash);
      if (changed.has('time')) this.showTime();
      if (changed.has('time') || changed.has('clash')) this.tellPlace();
    });
    this.show();
    this.showPlaying();
    this.showTime();
  }

  private show(): void {
    for (const marks of [this.lanes, this.impacts]) marks.show(this.visible());
  }

  private makeBar(): HTMLElement {
    const speeds = chooser(
      kSpeeds.map((speed) => [String(speed), `${speed} ×`]),
      (speed) => (this.speed = Number(speed)),
      { id: 'speed', 'aria-label': 'Speed', title: 'Speed' },
    );
    speeds.value = '1';
    const step = (by: 1 | -1, text: string, title: string, key: string) =>
      button(text, () => this.step(by), { 'aria-label': title, title: `${title} (${key})`, class: 'frame-step' });
    return el(
      'div',
      { class: 'time-bar', role: 'group', 'aria-label': 'Play' },
      step(-1, '◂', 'Frame before', '←'),
      this.playButton,
      step(1, '▸', 'Frame after', '→'),
      el('div', { class: 'time-words' }, this.readout, this.now),
      speeds,
      el('label', { class: 'check' }, this.repeat, ' Repeat'),
    );
  }

  /** At round numbers, no more than there is room for. */
  private makeTicks(): void {
    const length = this.last - this.first;
    if (!(length > 0)) return;
    const power = 10 ** Math.floor(Math.log10(length / 8));
    const step = power * [1, 2, 5, 10].find((digit) => length / (power * digit) <= 8)!;
    for (let i = Math.ceil(this.first / step - 1e-9); i * step <= this.last + 1e-9 * step; ++i) {
      const tick = el('span', { class: 'tick', 'aria-hidden': 'true' }, rounded(Number((i * step).toPrecision(12))));
      tick.style.left = `${100 * this.shareOf(i * step)}%`;
      this.slider.append(tick);
    }
  }

  private shareOf(time: number): number {
    const length = this.last - this.first;
    return length > 0 ? Math.min(1, Math.max(0, (time - this.first) / length)) : 0;
  }

  private listenToPointer(tracks: HTMLElement): void {
    const follow = (event: PointerEvent) => {
      const { left, width } = this.field.getBoundingClientRect();
      this.seek(this.first + Math.min(1, Math.max(0, (event.clientX - left) / width)) * (this.last - this.first));
    };
    let isHeld = false;
    tracks.addEventListener('pointerdown', (event) => {
      const target = event.target as HTMLElement;
      if (event.button !== 0 || target.closest('button') || target.closest('.lane-name')) return;
      // The bar for scrolling is no place of time.
      if (event.offsetX > tracks.clientWidth && target === tracks) return;
      isHeld = true;
      tracks.setPointerCapture(event.pointerId);
      this.pause();
      follow(event);
      this.slider.focus({ preventScroll: true });
      event.preventDefault();
    });
    tracks.addEventListener('pointermove', (event) => isHeld && follow(event));
    for (const end of ['pointerup', 'pointercancel'] as const) tracks.addEventListener(end, () => (isHeld = false));
  }

  private key(event: KeyboardEvent): void {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    const by = { ArrowDown: -1, ArrowUp: 1, PageDown: -10, PageUp: 10 }[event.key];
    const shortcut = this.shortcuts().find(({ keys }) => keys.includes(event.key));
    if (by) this.step(by);
    else if (shortcut) shortcut.act(event.key);
    else return;
    event.preventDefault();
    event.stopPropagation();
  }

  shortcuts(): Shortcut[] {
    return [
      { keys: [' '], text: 'play, pause', act: () => this.toggle() },
      { keys: ['ArrowLeft'], text: 'the frame before', act: () => this.step(-1) },
      { keys: ['ArrowRight'], text: 'the frame after', act: () => this.step(1) },
      { keys: ['Home'], text: 'to the start of the motion', act: () => this.jump(this.first) },
      { keys: ['End'], text: 'to its end', act: () => this.jump(this.last) },
    ];
  }

  seek(time: number): void {
    if (Number.isFinite(time)) this.store.set({ time: Math.min(this.last, Math.max(this.first, time)) });
  }

  private jump(time: number): void {
    this.pause();
    this.seek(time);
  }

  /** By frames; from between two frames, first to the next. */
  private step(by: number): void {
    const { times } = this.motion;
    const { time } = this.store.state;
    const frame = frameAt(times, time);
    const isBetween = times[frame] < time;
    const goal = frame + by + Number(by < 0 && isBetween);
    this.jump(times[Math.min(times.length - 1, Math.max(0, goal))]);
  }

  private toggle(): void {
    if (this.isPlaying) return this.pause();
    if (this.store.state.time >= this.last) this.seek(this.first);
    this.isPlaying = true;
    this.lastTick = performance.now();
    this.showPlaying();
    byId('live').textContent = 'Playing';
    requestAnimationFrame((now) => this.tick(now));
  }

  private pause(): void {
    if (!this.isPlaying) return;
    this.isPlaying = false;
    this.showPlaying();
    this.showTime();
    this.tellPlace();
    byId('live').textContent = `Paused at ${this.timeText()}`;
  }

  private tick(now: number): void {
    if (!this.isPlaying) return;
    const passed = Math.min(kLongestStep, Math.max(0, (now - this.lastTick) / 1000));
    this.lastTick = now;
    let time = this.store.state.time + passed * this.speed;
    const length = this.last - this.first;
    if (this.repeat.checked && length > 0) time = this.first + ((time - this.first) % length);
    this.seek(time);
    if (time >= this.last) this.pause();
    else requestAnimationFrame((next) => this.tick(next));
  }

  private showPlaying(): void {
    const title = this.isPlaying ? 'Pause' : 'Play';
    this.playButton.textContent = title;
    this.playButton.title = `${title} (Space)`;
  }

  private timeText(): string {
    return `${this.store.state.time.toFixed(this.decimals)} s`;
  }

  /** So many that two frames differ, and some more to tell what lies between them. */
  private get decimals(): number {
    const step = (this.last - this.first) / Math.max(1, this.motion.times.length - 1);
    return step > 0 ? Math.min(9, Math.max(3, 1 - Math.floor(Math.log10(step)))) : 3;
  }

  private showTime(): void {
    const { time } = this.store.state;
    const frames = this.motion.times.length - 1;
    const frame = frameAt(this.motion.times, time);
    this.head.style.left = `${100 * this.shareOf(time)}%`;
    const clashing = this.clashes.filter(({ pair }) => pair?.span && pair.span.start <= time && time <= pair.span.end);
    const count = clashing.length ? `${plural(clashing.length, 'clash', 'clashes')} now` : 'no clash now';
    this.readout.replaceChildren(
      el('b', {}, this.timeText()),
      el('small', {}, ` of ${rounded(this.last)} s, frame ${counted(frame)} of ${counted(frames)}`),
    );
    this.now.textContent = count;
    this.now.classList.toggle('bad', clashing.length > 0);
    // What plays would be read out without end.
    if (this.isPlaying) return;
    this.slider.setAttribute('aria-valuenow', String(time));
    this.slider.setAttribute('aria-valuetext', `${this.timeText()}, ${count}`);
  }

  /** Once it has come to rest: browsers refuse to be told too often. */
  private tellPlace(): void {
    clearTimeout(this.telling);
    if (this.isPlaying) return;
    this.telling = setTimeout(() => {
      const { clash, time } = this.store.state;
      const steps = clash ? [`clash=${clash.rank}`] : [];
      const usual = clash?.pair?.span?.start ?? this.first;
      if (time !== usual) steps.push(`t=${Number(time.toPrecision(9))}`);
      tellAddress(steps.length ? `#${steps.join('&')}` : '');
    }, 200);
  }
}
