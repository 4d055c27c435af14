// The debugger driven by the client that Visual Studio Code's own debug adapters are tested with. test_dap.py runs it.
// SPDX-License-Identifier: MIT
"use strict";
const assert = require("assert");
const { DebugClient } = require("@vscode/debugadapter-testsupport");

const lines = JSON.parse(process.env.INS_LINES);
const source = process.env.INS_SOURCE;
const folder = source.slice(0, source.lastIndexOf("/"));
const launch = { program: process.env.INS_IMAGE, sourceDirs: [folder], set: { xdata_octets: 256, stop_s: 1000 } };
const thread = { threadId: 1 };

describe("ins debug --dap", () => {
    let dc;
    beforeEach(() => {
        dc = new DebugClient(process.env.INS_PYTHON, process.env.INS_ADAPTER, "ins");
        dc.defaultTimeout = 60000;
        return dc.start();
    });
    afterEach(() => dc.stop());

    const hit = (mark) => dc.hitBreakpoint(launch, { path: source, line: lines[mark] });
    const stopped = async (request, reason) => {
        const [, event] = await Promise.all([request, dc.waitForEvent("stopped")]);
        assert.strictEqual(event.body.reason, reason);
        return (await dc.stackTraceRequest(thread)).body.stackFrames;
    };
    const value = async (expression) => (await dc.evaluateRequest({ expression })).body.result;

    it("stops at the line of a breakpoint and shows the stack", async () => {
        await hit("twice 1");
        const frames = (await dc.stackTraceRequest(thread)).body.stackFrames;
        assert.deepStrictEqual(frames.map((f) => f.name), ["twice", "count", "main"]);
        assert.strictEqual(frames[1].line, lines["count 1"]);
    });

    it("steps over, into and out", async () => {
        await hit("count 1");
        assert.strictEqual((await stopped(dc.nextRequest(thread), "step"))[0].line, lines["by pointer"]);
        assert.strictEqual((await stopped(dc.stepInRequest(thread), "step"))[0].name, "twice");
        assert.strictEqual((await stopped(dc.stepOutRequest(thread), "step"))[0].line, lines["by pointer"]);
    });

    it("steps and runs back", async () => {
        await hit("count 3");
        const before = await value("values[1]");
        assert.strictEqual((await stopped(dc.send("stepBack", thread), "step"))[0].line, lines["by pointer"]);
        await stopped(dc.continueRequest(thread), "breakpoint");
        await stopped(dc.continueRequest(thread), "breakpoint");
        assert.strictEqual(await value("values[1]"), String(Number(before) + 1));
        await stopped(dc.send("reverseContinue", thread), "breakpoint");
        assert.strictEqual(await value("values[1]"), before);
    });

    it("shows variables and sets them", async () => {
        await hit("count 1");
        const { scopes } = (await dc.scopesRequest({ frameId: 0 })).body;
        assert.deepStrictEqual(scopes.map((s) => s.name), ["Locals", "Globals", "Registers", "SFRs"]);
        const inside = scopes[1].variablesReference;
        const globals = (await dc.variablesRequest({ variablesReference: inside })).body.variables;
        const point = globals.find((v) => v.name === "point");
        const members = (await dc.variablesRequest(point)).body.variables;
        assert.deepStrictEqual(members.map((v) => [v.name, v.value]), [["x", "-3"], ["y", "4"]]);
        await dc.setVariableRequest({ variablesReference: point.variablesReference, name: "x", value: "2 * 50" });
        assert.strictEqual(await value("point.x + pointer->x"), "200");
    });

    it("stops where data is written, under a condition", async () => {
        await hit("count 1");
        const info = (await dc.send("dataBreakpointInfo", { name: "far[0]" })).body;
        const breakpoints = [{ dataId: info.dataId, accessType: "write" }];
        await dc.send("setDataBreakpoints", { breakpoints });
        await dc.setBreakpointsRequest({ source: { path: source }, breakpoints: [] });
        assert.strictEqual((await stopped(dc.continueRequest(thread), "data breakpoint"))[0].name, "main");
        const breakpoint = { line: lines["count 1"], condition: "values[1] == 30" };
        await dc.send("setDataBreakpoints", { breakpoints: [] });
        await dc.setBreakpointsRequest({ source: { path: source }, breakpoints: [breakpoint] });
        await stopped(dc.continueRequest(thread), "breakpoint");
        assert.strictEqual(await value("values[1]"), "30");
    });

    it("pauses a running board", async () => {
        await Promise.all([dc.configurationSequence(), dc.launch(launch)]);
        await dc.threadsRequest();
        await stopped(dc.pauseRequest(thread), "pause");
        assert.ok(Number(await value("$cycle")) > 0);
    });

    it("disassembles, reads and writes memory, stops at instructions", async () => {
        await hit("count 1");
        const [top] = (await dc.stackTraceRequest(thread)).body.stackFrames;
        const memoryReference = top.instructionPointerReference;
        const asked = { memoryReference, instructionOffset: -2, instructionCount: 6 };
        const { instructions } = (await dc.send("disassemble", asked)).body;
        assert.strictEqual(instructions.length, 6);
        assert.strictEqual(instructions[2].address, memoryReference);
        const at = { memoryReference: "iram:0x0040" };
        await dc.send("writeMemory", { ...at, data: Buffer.from([1, 2, 3]).toString("base64") });
        const read = (await dc.send("readMemory", { ...at, offset: 1, count: 2 })).body;
        assert.deepStrictEqual([...Buffer.from(read.data, "base64")], [2, 3]);
        const breakpoints = [{ instructionReference: instructions[4].address }];
        await dc.send("setInstructionBreakpoints", { breakpoints });
        const frames = await stopped(dc.continueRequest(thread), "breakpoint");
        assert.strictEqual(frames[0].instructionPointerReference, instructions[4].address);
    });

    it("ends", async () => {
        await hit("loop 2");
        await Promise.all([dc.send("terminate"), dc.waitForEvent("terminated")]);
    });
});
