// The lesson: steps with formulae, each number beside the register that holds it.

class Lesson {
  constructor(app) {
    this.app = app;
    this.at = 0;
    const { doc } = app;
    const tabs = document.getElementById("tabs");
    if (!doc.lesson.length) return;
    this.tabs = ["Replay", "Lesson"].map((name, number) => {
      const tab = make("button", { type: "button", onclick: () => this.show(number === 1) }, name);
      tabs.append(tab);
      return tab;
    });
    this.panel = document.getElementById("lesson");
    this.steps = make("div", { class: "steps" });
    this.body = make("div", {});
    this.panel.append(this.steps, this.body);
    this.buttons = doc.lesson.map((step, number) => {
      const button = make("button", { type: "button", onclick: () => this.step(number) }, step.title);
      this.steps.append(button);
      return button;
    });
  }
  get exists() {
    return this.app.doc.lesson.length > 0;
  }
  show(on) {
    this.on = on && this.exists;
    document.body.classList.toggle("teaching", this.on);
    if (!this.exists) return;
    this.tabs.forEach((tab, number) => tab.setAttribute("aria-pressed", String(on === (number === 1))));
    if (on) this.step(this.at);
    else this.mark([]);
    this.app.resize();
  }
  step(number) {
    const { doc } = this.app;
    this.at = Math.min(doc.lesson.length - 1, Math.max(0, number));
    const step = doc.lesson[this.at];
    this.buttons.forEach((button, i) => button.setAttribute("aria-current", i === this.at ? "step" : "false"));
    const where = make("small", {}, ` docs/machine.md ${step.sections.map((n) => `\u00a7${n}`).join(", ")}, cycle ${this.app.label(step.cycle)}`);
    const parts = [make("h2", {}, `${this.at + 1}. ${step.title}`, where)];
    for (const part of step.parts) parts.push(part.text ? make("p", {}, part.text) : this.formula(part));
    this.body.replaceChildren(...parts);
    this.app.go(step.cycle);
    this.mark(step.parts.filter((part) => part.check && part.check.register !== null && part.check.cycle === step.cycle)
      .map((part) => part.check.register));
  }
  // A formula with its number, and whether the register says the same.
  formula(part) {
    const line = make("p", { class: "formula" }, `${part.formula} = `, make("b", {}, part.value.replace("-", MINUS)));
    const { check } = part;
    if (!check) return line;
    let { found, same } = check;
    if (check.register !== null) {
      const register = this.app.doc.registers[check.register];
      const own = rawAt(register, check.cycle);
      const field = check.field === null ? null : this.app.doc.tokens[register.shape.table].fields[check.field];
      const raw = field ? (own ? field.raw[own - 1] : NONE) : own;
      same = String(raw) === check.raw;
      found = raw === NONE ? NONE : String(numberOf((field || register).shape, raw));
    }
    const text = `${same ? "\u2713" : "\u2717"} ${check.name} = ${found.replace("-", MINUS)}`;
    line.append(" ", make("span", { class: same ? "same" : "other" }, text));
    return line;
  }
  mark(ids) {
    for (const element of document.querySelectorAll(".taught")) element.classList.remove("taught");
    for (const id of ids) {
      for (const element of document.querySelectorAll(`[data-register="${id}"]`)) element.classList.add("taught");
    }
  }
}
