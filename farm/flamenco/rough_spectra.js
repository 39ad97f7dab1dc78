// SPDX-FileCopyrightText: 2026 Rough Spectra authors
// SPDX-License-Identifier: GPL-3.0-or-later

// Job type of Flamenco 3: put this file into the folder `scripts` beside `flamenco-manager`.
// Workers need Blender with the extension installed, as the variable {blender} names it.

const JOB_TYPE = {
  label: "Rough Spectra",
  description: "Read the materials of scenes with the virtual spectrophotometer, and judge them",
  settings: [
    { key: "scenes", type: "string", subtype: "dir_path", required: true, visible: "submission",
      eval: "str(Path(bpy.data.filepath).parent)",
      description: "A .blend, a folder of which all .blend files below count, or a text with a path a line" },
    { key: "output", type: "string", subtype: "dir_path", required: true, visible: "submission",
      description: "Folder of the readings, which all workers share" },
    { key: "tasks", type: "int32", default: 8, propargs: { min: 1, max: 1000 }, visible: "submission",
      description: "How many tasks share the work" },
    { key: "shards", type: "int32", default: 1, propargs: { min: 1, max: 1000 }, visible: "submission",
      description: "Parts that each scene is baked in; 1 unless a scene has thousands of materials" },
    { key: "words", type: "string", default: "bake --skip-done", visible: "submission",
      description: "Verb and options; {name} and {file} in them stand for each scene's name and path" },
    { key: "max_delta_e", type: "float", default: 1.0, propargs: { min: 0 }, visible: "submission",
      description: "The largest ΔE00 that passes; of bake" },
    { key: "blendfile", type: "string", required: false, visible: "hidden",
      description: "The file that the job was submitted from" },
  ],
};

function compileJob(job) {
  const settings = job.settings;
  const isBake = settings.words.trim().split(/\s+/)[0] === "bake";
  const work = [];
  for (let number = 1; number <= settings.tasks; number++) {
    const share = `${number}/${settings.tasks}`;
    const task = author.Task(`read-${number}-of-${settings.tasks}`, "blender");
    task.addCommand(command(settings, isBake, ["--task", share], settings.words));
    job.addTask(task);
    work.push(task);
  }
  if (!isBake) {
    return;
  }
  const judge = author.Task("judge", "blender");
  judge.addCommand(command(settings, isBake, [], `merge --max-delta-e ${settings.max_delta_e}`));
  for (const task of work) {
    judge.addDependency(task);
  }
  job.addTask(judge);
}

function command(settings, isBake, share, words) {
  const args = ["-b", "--command", "rough_spectra", "job"];
  args.push("--files", settings.scenes, "--output", settings.output);
  if (isBake) {
    args.push("--shards", `${settings.shards}`);
  }
  return author.Command("exec", { exe: "{blender}", args: args.concat(share, ["--", words]) });
}
