// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
//
// The 3D view with everything around it: it follows the choices, and the choices follow clicks in it.
import { Assembly } from './assembly';
import type { UpAxis } from './camera';
import { placeOf } from './clashes';
import { ClashView } from './clash-view';
import { Controls } from './controls';
import { Cube, faceTo, kFaces } from './cube';
import { BlockError, readGeometryText, type Report, type SceneBlock, type Vec3 } from './data';
import { byId, el, letterOf, nameOf } from './dom';
import { Explode } from './explode';
import { counted, nameText } from './format';
import { readMeshes } from './geometry';
import type { Shortcut } from './keys';
import { type Motion, posesAt } from './motion';
import { Section } from './section';
import type { State, Store } from './store';
import { Tools } from './tools';
import { add, emptyBox, middleOf, unite } from './vector';
import { View } from './view';

const isStill = (): boolean =>
  matchMedia('(prefers-reduced-motion: reduce)').matches || new URLSearchParams(location.search).has('still');

/** How the list is put together; nothing of it is seen in the view. */
const kOfTheList: ReadonlySet<keyof State> = new Set(['filter', 'sort', 'group'] as const);

export class Stage {
  view: View | null = null;
  private look: ClashView | null = null;
  private tools: Tools | null = null;
  private section: Section | null = null;
  private explode: Explode | null = null;
  private readonly note = byId('stage-note');
  private readonly hover = byId('hover');

  constructor(
    private readonly report: Report,
    private readonly store: Store,
    private readonly motion: Motion | null,
    private readonly hasClashes: () => boolean,
  ) {
    store.listen((state, changed) => this.follow(state, changed));
  }

  /** Reads the geometry and shows it. Rejects with a BlockError if it cannot be read; tells where there is no WebGL. */
  async load(scene: SceneBlock): Promise<void> {
    try {
      this.view = new View(byId('stage'), byId<HTMLCanvasElement>('canvas'), isStill);
    } catch {
      byId('stage').classList.add('no-view');
      this.note.textContent =
        'This browser offers no WebGL 2, so there is no 3D view. The list, the parts and all figures are complete.';
      return;
    }
    const { view } = this;
    const total = scene.meshes.reduce((sum, mesh) => sum + mesh.triangles, 0);
    this.note.textContent = `Reading ${counted(total)} triangles …`;
    try {
      const meshes = await readMeshes(readGeometryText(), scene);
      const assembly = await Assembly.create(scene, meshes);
      this.look = new ClashView(this.report, scene, assembly);
      if (this.motion) assembly.setSweep(this.motion.objects);
      view.show(assembly);
    } catch (error) {
      this.note.textContent = 'There is no 3D view of this report.';
      throw error instanceof BlockError ? error : new BlockError(`The 3D view cannot be made: ${String(error)}`);
    }
    this.note.textContent = '';
    this.furnish(view);
    const { state } = this.store;
    this.moveParts(state.time);
    this.look.applyLooks(state);
    const up: UpAxis = scene.up === 'y' ? 'y' : 'z';
    view.camera.up = up;
    byId<HTMLSelectElement>('up-axis').value = up;
    const { bounds } = view.assembly!;
    view.camera.stand = {
      ...view.camera.stand,
      target: middleOf(bounds),
      distance: view.camera.distanceForBox(bounds) || 1,
    };
    if (state.clash) this.follow(state, new Set(['clash']));
    else if (state.part >= 0) this.follow(state, new Set(['part']));
    view.invalidate();
  }

  private clashPlace(): Vec3 | null {
    const { clash, region } = this.store.state;
    if (!clash) return null;
    if (region >= 0) return clash.pair!.regions![region].centroid;
    return placeOf(clash) ?? this.look?.focus(this.store.state)?.middle ?? null;
  }

  private furnish(view: View): void {
    const bounds = () => view.assembly!.bounds;
    this.section = new Section(
      {
        bounds,
        back: () => view.camera.axes().back,
        clashPlace: () => this.clashPlace(),
        cut: (plane) => view.setSection(plane),
      },
      (isOn) => this.tools?.mark('section', isOn),
    );
    this.explode = new Explode(
      () => middleOf(bounds()),
      () => this.clashPlace(),
      (factor, centre) => {
        view.assembly!.setExplosion(factor, centre);
        this.tools?.mark('explode', factor > 0);
        view.invalidate();
      },
    );
    this.tools = new Tools(this.store, this.motion !== null, this.section, this.explode, {
      fit: () => this.fitAll(),
      redraw: () => view.invalidate(),
      camera: view.camera,
    });
    byId('tools').hidden = byId('cube').hidden = false;
    const cube = new Cube(byId('cube'), view.camera);
    view.onFrame = () => cube.update();
    new Controls(view, {
      onClick: (part, isTwice) => this.click(part, isTwice),
      onRest: (part, x, y) => this.showHover(part, x, y),
      onLeave: () => (this.hover.hidden = true),
    });
  }

  private click(part: number, isTwice: boolean): void {
    if (isTwice && part >= 0) this.fitParts([part]);
    if (part >= 0 || !this.store.state.clash)
      this.store.set({ part, clash: part >= 0 ? null : this.store.state.clash });
  }

  private showHover(part: number, x: number, y: number): void {
    if (part < 0) return;
    this.hover.textContent = nameText(this.report.objects[part].name, 80);
    this.hover.hidden = false;
    const room = byId('stage').clientWidth - this.hover.offsetWidth - 8;
    this.hover.style.transform = `translate(${Math.max(4, Math.min(x + 14, room))}px, ${y + 18}px)`;
  }

  /** True if others clash than before. */
  private moveParts(time: number): boolean {
    const { assembly } = this.view ?? {};
    if (!this.motion || !assembly) return false;
    for (const { id, pose } of posesAt(this.motion, time)) assembly.movePart(id, pose);
    assembly.place();
    return this.look!.takeTime(time);
  }

  private follow(state: State, changed: ReadonlySet<keyof State>): void {
    const { view, look } = this;
    if (changed.has('clash')) this.showLegend(state);
    if (!view || !look || [...changed].every((key) => kOfTheList.has(key))) return;
    const doOthersClash = changed.has('time') && this.moveParts(state.time);
    const isElsewhere = changed.has('clash') || changed.has('region');
    const from = isElsewhere ? look.lookFrom(state, view.camera.goalBack()) : null;
    const looks: (keyof State)[] = ['clash', 'region', 'part', 'hidden', 'others', 'glass', 'colourBy'];
    if (doOthersClash || looks.some((key) => changed.has(key))) look.applyLooks(state);
    if (changed.has('clash') || changed.has('region') || changed.has('boxes')) view.setStrokes(look.strokes(state));
    if (from) {
      const focus = look.focus(state);
      if (focus) {
        const { camera } = view;
        camera.fly({ target: focus.middle, distance: camera.distanceFor(focus.radius), ...camera.anglesTo(from) });
      }
      this.section?.follow();
      this.explode?.follow();
    }
    view.invalidate();
  }

  private showLegend(state: State): void {
    const legend = byId('legend');
    const { clash } = state;
    legend.hidden = !clash;
    if (!clash) return;
    const entries = clash.names.map((name, side) => el('span', { class: 'entry' }, letterOf(side), nameOf(name, 60)));
    legend.replaceChildren(...entries);
  }

  takeTheme(): void {
    const { view, look } = this;
    if (!view || !look) return;
    view.takeTheme();
    look.applyLooks(this.store.state);
    view.setStrokes(look.strokes(this.store.state));
  }

  fitAll(): void {
    const { view } = this;
    if (!view?.assembly) return;
    const { hidden } = this.store.state;
    if (this.motion && !hidden.size) return view.fit(view.assembly.bounds);
    const seen = view.assembly.boxes.filter((_, id) => !hidden.has(id));
    view.fit(unite(seen.length ? seen : view.assembly.boxes));
  }

  fitParts(parts: number[]): void {
    const { view } = this;
    if (view?.assembly) view.fit(unite(parts.map((id) => view.assembly!.boxes[id])));
  }

  /** Where on the page the middle of a part is, for tests. */
  screenPlace(id: number): { x: number; y: number } | null {
    const { view } = this;
    const { assembly } = view ?? {};
    if (!view || !assembly || !assembly.hasMesh(id)) return null;
    return view.screenPlace(add(middleOf(assembly.boxes[id] ?? emptyBox()), assembly.shiftOf(id)));
  }

  closePanel(): boolean {
    return this.tools?.close() ?? false;
  }

  private frame(): void {
    const { state } = this.store;
    const focus = this.look?.focus(state);
    if (focus && this.view)
      this.view.camera.fly({ target: focus.middle, distance: this.view.camera.distanceFor(focus.radius) });
    else if (state.part >= 0) this.fitParts([state.part]);
    else this.fitAll();
  }

  shortcuts(): Shortcut[] {
    const { store } = this;
    const withPart = (act: (parts: number[]) => void) => () => {
      if (store.state.part >= 0) act([store.state.part]);
    };
    return [
      { keys: ['f'], text: 'fit what is chosen, or all', act: () => this.frame() },
      {
        keys: kFaces.map((face) => face.key),
        text: 'front, back, left, right, top, bottom',
        act: (key) => this.face(key),
      },
      { keys: ['h'], text: 'hide the chosen part, or show it', act: withPart((parts) => store.toggleHidden(parts)) },
      { keys: ['i'], text: 'isolate the chosen part', act: withPart((parts) => store.isolate(parts)) },
      { keys: ['a'], text: 'show all parts', act: () => store.showAll() },
      { keys: ['s'], text: 'section', act: () => this.tools?.toggle('section') },
      { keys: ['e'], text: 'explode', act: () => this.tools?.toggle('explode') },
      ...(this.hasClashes()
        ? [
            {
              keys: ['x'],
              text: 'see through both parts of the clash',
              act: () => store.set({ glass: !store.state.glass }),
            },
            {
              keys: ['b'],
              text: 'boxes of the regions of contact',
              act: () => store.set({ boxes: !store.state.boxes }),
            },
          ]
        : []),
      {
        keys: ['p'],
        text: 'parallel or perspective',
        act: () => this.tools?.setParallel(!this.view!.camera.isParallel),
      },
    ];
  }

  private face(key: string): void {
    const face = kFaces.find((one) => one.key === key);
    if (face && this.view) faceTo(this.view.camera, face);
  }
}
