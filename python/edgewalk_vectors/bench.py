"""The bench of a directory, clock by clock, without a simulator.

In each cycle `drive()` gives the inputs by the unit's names, and `sample(outputs)` takes the outputs before the clock's
edge. An output with unknown bits is None.
"""

from .directory import VectorsError


class Fault(AssertionError):
    """What a design did wrong."""


SHOWN = 5  # faults of a channel that are told
OTHER = "a token of the first run is not the next one"


class Source:
    """Offers tokens in order; one that is offered stays until it is taken."""

    def __init__(self, channel, tokens, willing):
        self.name, self.fields, self.tokens, self.willing = channel["name"], channel["fields"], tokens, willing
        self.sent, self.held = 0, False

    def drive(self, cycle, inputs):
        self.valid = self.sent < len(self.tokens) and (self.held or willing(self.willing, cycle))
        inputs[f"{self.name}_valid"] = int(self.valid)
        inputs.update(parts(self.fields, self.tokens[self.sent] if self.valid else 0))

    def sample(self, outputs, moved):
        fires = self.valid and outputs.get(f"{self.name}_ready") == 1
        self.held = self.valid and not fires
        if fires:
            moved[self.name] = parts(self.fields, self.tokens[self.sent])
            self.sent += 1


class Memory(Source):
    """Gives the words of the addresses that were read, in order."""

    def __init__(self, channel, memory, directory, pattern):
        super().__init__(channel, [], pattern)
        self.memory, self.clear = memory, int(memory["clear"], 16)
        start = memory.get("start")
        self.words = dict(enumerate(directory.numbers(start))) if start else {}
        self.waiting = []

    def drive(self, cycle, inputs):
        due = bool(self.waiting) and self.waiting[0][0] <= cycle
        self.valid = due and (self.held or willing(self.willing, cycle))
        inputs[f"{self.name}_valid"] = int(self.valid)
        inputs.update(parts(self.fields, self.waiting[0][1] if self.valid else 0))

    def sample(self, outputs, moved):
        fires = self.valid and outputs.get(f"{self.name}_ready") == 1
        self.held = self.valid and not fires
        if fires:
            self.waiting.pop(0)
            moved[self.name] = {}

    def serve(self, cycle, moved):
        """A read sees the word before a write of its own cycle."""
        read = moved.get(self.memory["read"])
        if read:
            address = next(iter(read.values()))
            self.waiting.append((cycle + self.memory["latency"], self.words.get(address, self.clear)))
        write = self.memory.get("write")
        token = moved.get(write["channel"]) if write else None
        if token and ("enable" not in write or token[write["enable"]]):
            self.words[token[write["address"]]] = token[write["word"]]


class Offered:
    """The rule of a channel out: a token that is offered stays as it is until it is taken."""

    def __init__(self):
        self.last = None

    def broken(self, valid, token, ready):
        """Whether the rule is broken in this cycle."""
        broken = self.last is not None and (valid != 1 or token != self.last)
        self.last = token if valid == 1 and not ready else None
        return broken


class Sink:
    """Compares the tokens that come out, and the cycles in which they do where these count."""

    def __init__(self, channel, directory, pattern, absent, by_cycle, shy):
        self.name, self.channel, self.willing = channel["name"], channel, pattern
        self.fields = [field for field in channel["fields"] if field["port"] not in absent]
        self.wanted = directory.numbers(channel["tokens"])
        self.cycles = directory.steps(channel["moved"]) if by_cycle and not shy else None
        triangles = channel["triangles"]
        self.triangles = directory.steps(triangles) if triangles else None
        self.directory, self.came, self.faults, self.offers = directory, 0, [], Offered()
        self.always = f"{self.name}_ready" in absent
        self.shy, self.waits, self.offered = shy and not self.always, False, False
        self.stands, self.ahead, self.early = False, False, None

    def drive(self, cycle, inputs, keep):
        wants = willing(self.willing, cycle) and not keep and (not self.shy or self.waits)
        self.ready = self.always or wants
        inputs[f"{self.name}_ready"] = int(self.ready)

    def sample(self, cycle, outputs, moved):
        valid = outputs[f"{self.name}_valid"]
        token = {field["port"]: outputs[field["port"]] for field in self.fields}
        # An unknown valid is taken for one.
        self.waits, self.offered = valid != 0 and not self.ready, self.offered or valid != 0
        self.stands = valid == 1 and not self.ready
        self.ahead = self.ahead or valid != 0 and (self.came > 0 or len(self.wanted) == 1)
        if self.offers.broken(valid, token, self.ready):
            self.faults.append(f"{self.name}: cycle {cycle}: the token changed, or valid fell, before it was taken")
        if valid is None:
            self.found_early(f"{self.name}_valid was unknown in the first run")
        if valid == 0 or not self.ready:
            return
        if self.came == len(self.wanted):
            self.faults.append(f"{self.name}: cycle {cycle}: one more than the {self.came} expected")
            self.found_early(OTHER)
            return
        if valid is None:
            self.faults.append(f"{self.where(cycle)}: {self.name}_valid: unknown bits")
        want = self.wanted[self.came]
        for field in self.fields:
            wanted, found = want >> field["lsb"] & (1 << field["width"]) - 1, token[field["port"]]
            if found != wanted:
                self.found_early(OTHER)
                shown = "unknown bits" if found is None else f"{found:x}"
                self.faults.append(f"{self.where(cycle)}: {field['port']}: expected {wanted:x}, found {shown}")
        if self.cycles is not None and cycle != self.cycles[self.came]:
            self.faults.append(f"{self.where(cycle)}: expected in cycle {self.cycles[self.came]}")
        # The memories go on with what ought to have come, so that one fault is not followed by many.
        moved[self.name] = parts(self.channel["fields"], want)
        self.came += 1

    def found_early(self, what):
        """Keeps the first fault that counts in a first run: there cycles do not."""
        self.early = self.early or f"{self.name}: {what}: does the reset reach {self.name}_valid?"

    def where(self, cycle):
        text = f"{self.name}: token {self.came}"
        if self.triangles is not None and self.came < len(self.triangles):
            triangle = self.triangles[self.came]
            text += f", triangle {triangle}, case {self.directory.case_of(triangle)}"
        return f"{text}, cycle {cycle}"


class Held:
    """Values held beside a channel out: from the first token of a triangle on they stay until the next is taken."""

    def __init__(self, rule, absent, by_cycle):
        self.rule, self.ports = rule, [port for port in rule["ports"] if port not in absent]
        # Compared by order, a design may have taken triangles whose first token has not moved.
        self.kept, self.last, self.ahead, self.by_cycle, self.faults = False, None, 0, by_cycle, []

    def sample(self, cycle, outputs, moved):
        values = [outputs[port] for port in self.ports]
        for port, before, now in zip(self.ports, self.last or [], values):
            if self.kept and now != before:
                shown = ["unknown bits" if value is None else f"{value:x}" for value in (before, now)]
                self.faults.append(
                    f"{port}: cycle {cycle}: changed before the next triangle was taken: {shown[0]}, then {shown[1]}"
                )
        self.last = values
        taken = self.rule["taken"] in moved
        if taken and self.rule["taken_with"]:
            taken = moved[self.rule["taken"]][self.rule["taken_with"]] == 1
        first = moved.get(self.rule["channel"], {}).get(self.rule["fresh"]) == 1
        self.ahead += taken - first
        self.kept = (self.kept or first) and not taken and (self.by_cycle or self.ahead <= 0)


class Bench:
    """Drives a design by a directory and compares what comes out.

    `drive()` returns the inputs of a cycle, `sample(outputs)` takes its outputs and says whether the run goes on, and
    `finish()` raises `Fault` unless everything expected came, as expected, and nothing else. Names are the unit's;
    `outputs` are those that are sampled. `absent` are ports that the design has not got, and `compare` is "cycle" or
    "order". A `shy` bench is that of the first run: it takes only tokens that it has seen waiting, and none from when each
    channel out has offered a second one. Cycles do not count in it.
    """

    def __init__(self, directory, absent=(), compare=None, shy=False):
        manifest = directory.manifest
        compare = compare or (manifest.get("dut") or {"compare": "cycle"})["compare"]
        if compare not in ("cycle", "order"):
            raise VectorsError(f"compare: {compare!r}; permitted: cycle, order")
        by_cycle = compare == "cycle"
        pattern = {name: directory.numbers(file, 2) for name, file in manifest["stalls"]["patterns"].items()}
        self.limits, self.levels, self.constants = manifest["limits"], manifest["side_inputs"], manifest["constants"]
        self.patterns = pattern
        memories = {memory["data"]: memory for memory in manifest["memories"]}
        self.sources, self.memories, self.sinks = {}, [], []
        for channel in manifest["channels"]:
            name = channel["name"]
            if channel["direction"] == "out":
                self.sinks.append(Sink(channel, directory, pattern[name], absent, by_cycle, shy))
            elif name in memories:
                self.memories.append(Memory(channel, memories[name], directory, pattern[name]))
            else:
                tokens = directory.numbers(channel["tokens"])
                self.sources[name] = Source(channel, tokens, pattern[name])
        self.held = [Held(rule, absent, by_cycle) for rule in manifest["held"]]
        status = manifest["status"]
        self.status = status["fields"] if by_cycle else []
        missing = [field["port"] for field in self.status if field["port"] in absent]
        if missing:
            raise VectorsError(f"ports: {missing[0]}: absent; permitted with compare = \"order\"")
        self.during = status["during"]
        changes = zip(directory.steps(status["moved"]), directory.numbers(status["tokens"]))
        self.changes = list(changes) if by_cycle else []
        self.seen, self.status_faults, self.shown = 0, [], None
        self.shy, self.stuck, self.early = shy, [], []
        self.cycle, self.quiet = 0, 0
        self.expected = len(self.changes) + sum(len(sink.wanted) for sink in self.sinks)

    @property
    def outputs(self):
        """Names of the outputs that are sampled."""
        names = [f"{source.name}_ready" for source in [*self.sources.values(), *self.memories]]
        for sink in self.sinks:
            names += [f"{sink.name}_valid", *(field["port"] for field in sink.fields)]
        return list(dict.fromkeys([*names, *(field["port"] for field in self.status)]))

    def drive(self):
        """The inputs of the next cycle, all of them but clock and reset."""
        inputs = dict(self.constants)
        for end in [*self.sources.values(), *self.memories]:
            end.drive(self.cycle, inputs)
        keep = self.shy and self.all_ahead()
        for sink in self.sinks:
            sink.drive(self.cycle, inputs, keep)
        for level in self.levels:
            source = self.sources[level["while_tokens_of"]]
            more = source.sent < len(source.tokens)
            inputs[level["port"]] = int(more and not willing(self.patterns[level["port"]], self.cycle))
        self.inputs = inputs
        return inputs

    def sample(self, outputs):
        """Takes the outputs of the cycle; false when the run is at its end."""
        moved = {}
        for source in [*self.sources.values(), *self.memories]:
            source.sample(outputs, moved)
        for sink in self.sinks:
            sink.sample(self.cycle, outputs, moved)
        for held in self.held:
            held.sample(self.cycle, outputs, moved)
        for memory in self.memories:
            memory.serve(self.cycle, moved)
        changed = self._watch(outputs)
        self.quiet = 0 if moved or changed else self.quiet + 1
        self.cycle += 1
        return self.quiet <= self.limits["idle"] and self.cycle < self.limits["cycles"]

    def _watch(self, outputs):
        """Whether the status ports changed; a change that is not the one expected is a fault."""
        if not self.status:
            return False
        value = 0
        for field in self.status:
            bits = outputs[field["port"]]
            guard = self.during.get(field["port"])
            if guard and outputs.get(guard, self.inputs.get(guard)) == 0:
                bits = 0
            value = None if bits is None or value is None else value | bits << field["lsb"]
        if self.cycle > 0 and value == self.shown:
            return False
        self.shown = value
        wanted = self.changes[self.seen] if self.seen < len(self.changes) else None
        if (self.cycle, value) != wanted:
            self.status_faults.append(f"status: change {self.seen}, cycle {self.cycle}: expected {wanted}, found {value}")
        self.seen += wanted is not None
        return True

    def all_ahead(self):
        """Whether each channel out has offered a second token, or has no more than it offered."""
        return all(sink.ahead or not sink.wanted for sink in self.sinks)

    def may_end(self):
        """Whether a first run may end: on each channel out that can be made to wait a token waits."""
        waits = all(sink.stands or sink.always or not sink.wanted for sink in self.sinks)
        return self.all_ahead() and waits

    def found_early(self):
        """What is wrong in a first run."""
        return [sink.early for sink in self.sinks if sink.early]

    def silent(self):
        """Channels out that never offered a token, though nothing happened any more."""
        quiet = self.quiet > self.limits["idle"]
        return [sink.name for sink in self.sinks if quiet and sink.wanted and sink.shy and not sink.offered]

    @property
    def checked(self):
        """Tokens and changes of the status that were compared."""
        return self.seen + sum(sink.came for sink in self.sinks)

    def finish(self):
        """Raises `Fault` unless all is right; returns what was checked."""
        told = list(self.status_faults[:SHOWN])
        for sink in self.sinks:
            # One that offers nothing here either has another fault.
            if sink.name in self.stuck and sink.came:
                told.append(
                    f"{sink.name}: {sink.name}_valid waits for {sink.name}_ready, which it must not: no token was offered "
                    f"in the first run, in which {sink.name}_ready is 0 until {sink.name}_valid is 1"
                )
            told += sink.faults[:SHOWN]
            missing = len(sink.wanted) - sink.came
            if missing:
                told.append(f"{sink.where(self.cycle)}: never came, the first of {missing}")
        for held in self.held:
            told += held.faults[:SHOWN]
        told += self.early
        if self.expected == 0 or not any(sink.wanted for sink in self.sinks):
            told.append("nothing was compared")
        if self.checked != self.expected:
            told.append(f"checked {self.checked} / {self.expected}")
        if told:
            raise Fault("\n".join(told))
        return self.checked


def parts(fields, token):
    """The fields of a packed token, by their ports."""
    return {field["port"]: token >> field["lsb"] & (1 << field["width"]) - 1 for field in fields}


def willing(pattern, cycle):
    return pattern[cycle % len(pattern)] == 1
