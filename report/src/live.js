// A served run: new frames and rows are fetched at intervals. The page can pause and stop the run if the program that serves it also runs it.
import { expectations, facts, provenance, statusBadge, warnings } from "./about.js";
import { contactSection, costSection, energySection, lawSection, probeSection } from "./curves.js";
import { button, h } from "./dom.js";
import { format } from "./format.js";
import { scoped } from "./theme.js";
import { viewSection, viewOf } from "./view.js";

const pause = { running: 400, idle: 2000 }; // ms between two updates
const margin = 300;                         // pixels around the window in which charts are updated
const mostRows = 3000;                      // of a growing table; above, every second row is dropped

// A growing table with the interface of numberTable (unpack.js).
class Growing {
  constructor(table) {
    this.columns = table?.columns ?? [];
    this.lists = new Map(this.columns.map((name) => [name, [...table.get(name)]]));
    this.seen = table?.of ?? 0; // rows of the file
  }

  append({ columns, next, rows }) {
    if (this.columns.length === 0) {
      this.columns = columns;
      this.lists = new Map(columns.map((name) => [name, []]));
    }
    for (const row of rows) row.forEach((number, c) => this.lists.get(columns[c]).push(number ?? NaN));
    this.seen = next;
    if (this.rows > mostRows) for (const [name, list] of this.lists) this.lists.set(name, list.filter((_, i) => (list.length - 1 - i) % 2 === 0));
  }

  get rows() { return this.lists.size > 0 ? this.lists.values().next().value.length : 0; }
  get of() { return this.seen; }
  get(name) { return this.lists.has(name) ? Float64Array.from(this.lists.get(name)) : undefined; }
}

export class Live {
  constructor({ generation, controlled }, run) {
    this.generation = generation;
    this.controlled = controlled;
    this.run = run;
    this.tables = { steps: new Growing(run.steps), probes: new Growing(run.probes) };
    this.written = run.frames?.written ?? 0;
    this.ended = Boolean(run.summary);
    // The sections of the page by name, in order; a section without content is empty.
    this.makers = { facts: () => facts([run]), warnings: () => warnings([run]), expectations: () => expectations([run]), view: () => viewSection([run], { newest: true }),
      probes: () => probeSection([run]), laws: () => lawSection([run]), energies: () => energySection([run]), contacts: () => contactSection([run]),
      cost: () => costSection([run]), provenance: () => provenance([run]) };
    this.slots = Object.fromEntries(Object.keys(this.makers).map((name) => [name, { element: h("div", { class: "slot" }), end: () => {} }]));
    Object.keys(this.makers).forEach((name) => this.make(name));
    this.badge = h("span", { class: "state" });
    this.progress = h("progress", { max: 1, value: 0, "aria-label": "progress of the run" });
    this.status = h("output", { class: "status-text" });
    this.holdButton = button("Pause", () => this.order(this.asked ? "resume" : "pause"), { class: "hold", disabled: true });
    this.stopButton = button("Stop", () => this.order("stop"), { class: "stop", disabled: true, title: "ends the run like Ctrl-C: all results are written" });
    this.bar = h("div", { class: "live", role: "group", "aria-label": "The run" }, this.badge, this.progress, this.status, controlled && [this.holdButton, this.stopButton]);
  }

  get parts() { return Object.values(this.slots).map(({ element }) => element); }

  begin(changed) {
    this.changed = changed;
    this.look();
  }

  make(name) {
    const slot = this.slots[name];
    slot.end();
    const [made, end] = scoped(this.makers[name]);
    slot.end = end;
    slot.element.replaceChildren(...[made].filter(Boolean));
  }

  // Returns true for a section that is not updated now: one in use, or one with charts outside the window.
  defers(name) {
    const { element } = this.slots[name];
    if (element.contains(document.activeElement) || element.querySelector(".reset:not([hidden]), details[open]")) return true;
    const { top, bottom } = element.getBoundingClientRect();
    return element.querySelector(".plot") !== null && (bottom < -margin || top > innerHeight + margin);
  }

  async look() {
    const begun = performance.now();
    const wait = await this.next();
    setTimeout(() => this.look(), Math.max(wait, 3 * (performance.now() - begun))); // at most a quarter of the time is spent drawing
  }

  // Updates the page, one update at a time.
  next() {
    this.turn = (this.turn ?? Promise.resolve()).then(() => this.update());
    return this.turn;
  }

  // Returns null if the program does not answer.
  async fetchNews() {
    const { steps, probes } = this.tables;
    try {
      const answer = await fetch(`news?steps=${steps.seen}&probes=${probes.seen}&frames=${this.written}&ended=${this.ended ? 1 : 0}`, { cache: "no-store" });
      if (answer.ok) return await answer.json();
    } catch {
      // as below
    }
    this.say("not reachable", "open", "the program that served this page has ended");
    this.holdButton.disabled = this.stopButton.disabled = true;
    this.bar.dataset.state = "gone";
    return null;
  }

  async update() {
    const news = await this.fetchNews();
    if (!news) return pause.idle;
    if (news.generation !== this.generation) {
      location.reload(); // the program serves another run
      return pause.idle;
    }
    await this.take(news);
    this.showState(news);
    return news.running ? pause.running : pause.idle;
  }

  async take(news) {
    const { run } = this;
    const changed = new Set();
    for (const name of ["steps", "probes"]) {
      if (!news[name]) continue;
      this.tables[name].append(news[name]);
      run[name] = this.tables[name];
      ["facts", ...(name === "steps" ? ["energies", "contacts", "cost"] : ["probes"])].forEach((one) => changed.add(one));
    }
    if (news.frames) {
      this.written = news.frames.written;
      await this.takeFrames(news.frames);
      changed.add("facts");
    }
    if (news.running && this.ended) this.ended = false; // it was resumed
    if (news.end) {
      this.ended = true;
      Object.assign(run, news.end);
      Object.keys(this.makers).filter((name) => name !== "view").forEach((name) => changed.add(name));
    }
    this.waiting = new Set([...(this.waiting ?? []), ...changed]);
    for (const name of [...this.waiting].filter((one) => !this.defers(one))) {
      this.waiting.delete(name);
      this.make(name);
    }
    if (changed.size > 0) this.changed();
  }

  async takeFrames(frames) {
    const view = viewOf(this.slots.view.element.querySelector("section"));
    if (view) {
      this.run.frames = { ...this.run.frames, written: frames.written, times: [...this.run.frames.times, ...frames.times] };
      return view.append(frames);
    }
    this.run.frames = frames;
    this.make("view");
    return undefined;
  }

  showState({ running, progress: p }) {
    const end = p?.end ?? this.run.scene?.duration;
    const time = p?.time ?? this.tables.steps.get("time")?.at(-1) ?? 0;
    const step = p?.step ?? this.tables.steps.get("step")?.at(-1) ?? 0;
    this.progress.value = end > 0 ? Math.min(1, time / end) : 0;
    const parts = [`step ${step}`, `t = ${format(time, 4)} s${end ? ` of ${format(end, 4)} s` : ""}`];
    if (p?.iterations) parts.push(`${p.iterations} iteration${p.iterations === 1 ? "" : "s"}`);
    if (running && p?.iteration > 0 && !p.holding) parts.push(`current step: iteration ${p.iteration}, residual ${format(p.residual, 3)}`);
    this.asked = Boolean(p?.paused);
    const state = !running ? this.run.status : p?.stopped ? "stopping" : p?.holding ? "paused" : p?.paused ? "pausing" : "running";
    this.say(state, null, parts.join(", "));
    this.holdButton.textContent = this.asked ? "Resume" : "Pause";
    this.holdButton.disabled = this.stopButton.disabled = !running || Boolean(p?.stopped);
    this.bar.dataset.state = state;
    this.bar.dataset.step = step;
    this.bar.dataset.frames = this.written;
  }

  say(state, kind, text) {
    const known = { running: "open", paused: "open", pausing: "open", stopping: "open" };
    this.badge.replaceChildren((kind ?? known[state]) ? h("span", { class: `badge ${kind ?? known[state]}` }, state) : statusBadge(state));
    this.status.textContent = text;
  }

  async order(what) {
    this.holdButton.disabled = true;
    await fetch(what, { method: "POST", cache: "no-store" }).catch(() => {});
    await this.next();
  }
}
