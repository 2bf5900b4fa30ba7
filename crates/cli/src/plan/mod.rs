//! Scripts that have all shards of a study run, and merge their results.

mod dask;
mod hyper_queue;
mod shell;
mod slurm;

use std::path::Path;

use pounding_catalogue::wording::counted;
use pounding_files::FileUse;
use pounding_study::{Study, Value, default_result, refuse_name_of_shard, writable};
use serde::Serialize;

use crate::arguments::{PlanArguments, RunningArguments, Scheduler, time_limit};
use crate::command_words::{quoted, shell_line};
use crate::failure::Failure;
use crate::files::{have_a_place, reads_too};
use crate::output::{note, pretty, print, print_as_it_is};
use crate::study::{name, table_has_a_place};

/// What is planned: the command, as it was given.
pub struct Planned<'p> {
    /// `sweep` or `ida`.
    pub command: &'static str,
    /// Options that belong to the whole study, for a last call of the command.
    pub at_the_end: Vec<String>,
    /// Tables, pages and figures that this call writes.
    pub written_at_the_end: &'p [Option<&'p Path>],
    /// How it is run.
    pub running: &'p RunningArguments,
    /// Folder of the shards, if one is named.
    pub into: Option<&'p Path>,
    /// How it is handed out.
    pub planning: &'p PlanArguments,
}

/// All that scripts are made of.
#[derive(Debug)]
struct Plan {
    /// Name of the study.
    name: String,
    runs: usize,
    chunk: usize,
    shards: usize,
    /// Tasks of a Slurm array, which take several shards if these are more.
    tasks: usize,
    threads: u32,
    /// Time limit of a task (s).
    time: Option<f64>,
    at_once: Option<u32>,
    /// Folder of the results.
    folder: String,
    /// Where the commands are called.
    here: String,
    /// The command that runs a shard, but for its number.
    command: Vec<String>,
    /// Commands that make the whole result, one after another.
    at_the_end: Vec<Vec<String>>,
    /// The command that lists what is missing.
    unfinished: Vec<String>,
    /// What the user should know.
    notes: Vec<String>,
}

/// What `--plan --json` prints.
#[derive(Serialize)]
struct Scripts<'p> {
    runs: usize,
    chunk: usize,
    shards: usize,
    slurm_tasks: usize,
    folder: &'p str,
    notes: &'p [String],
    slurm: String,
    hyper_queue: String,
    dask: String,
    shell: String,
}

/// Prints how a study is dealt in shards, or one of the scripts. That the outputs have no place is found out now, not
/// after the runs; `files` are those of the arguments.
pub fn print_plan(
    study: &Study,
    planned: &Planned<'_>,
    (scheduler, json): (Option<Scheduler>, bool),
    files: &mut FileUse,
) -> Result<(), Failure> {
    outputs_have_a_place(study, planned, files)?;
    let plan = Plan::of(study, planned)?;
    if !json {
        has_effect(planned.planning, scheduler)?;
    }
    if json {
        return print(&pretty(&Scripts {
            runs: plan.runs,
            chunk: plan.chunk,
            shards: plan.shards,
            slurm_tasks: plan.tasks,
            folder: &plan.folder,
            notes: &plan.notes,
            slurm: slurm::script(&plan),
            hyper_queue: hyper_queue::script(&plan),
            dask: dask::script(&plan),
            shell: shell::script(&plan),
        })?);
    }
    plan.notes.iter().for_each(|text| note(text));
    match scheduler {
        Some(Scheduler::Slurm) => print_as_it_is(&slurm::script(&plan)),
        Some(Scheduler::HyperQueue) => print_as_it_is(&hyper_queue::script(&plan)),
        Some(Scheduler::Dask) => print_as_it_is(&dask::script(&plan)),
        Some(Scheduler::Shell) => print_as_it_is(&shell::script(&plan)),
        None => print(&plan.overview(study)),
    }
}

/// Holds the outputs of the commands that a plan prints against the files of the study, as those commands will.
fn outputs_have_a_place(
    study: &Study,
    planned: &Planned<'_>,
    files: &mut FileUse,
) -> Result<(), Failure> {
    let running = planned.running;
    let output = match &running.output {
        Some(output) => output.to_path_buf(),
        None => {
            let output = default_result(&study.file);
            files.writes("result", &output);
            output
        }
    };
    reads_too(files, study.files())?;
    refuse_name_of_shard(&output, None)?;
    writable(&output)?;
    if let Some(csv) = &running.csv {
        table_has_a_place(csv)?;
    }
    have_a_place(planned.written_at_the_end.iter().copied())?;
    match planned.into {
        Some(into) if into.ancestors().any(|at| at.exists() && !at.is_dir()) => {
            Err(Failure::input(
                format!("--into {} is no folder", into.display()),
                Some("name a folder for the results of the shards".to_owned()),
            ))
        }
        _ => Ok(()),
    }
}

/// `MaxArraySize` of a cluster that does not say another.
const ARRAY_LIMIT: u32 = 1001;

/// Refuses options that the script that is printed does not carry.
fn has_effect(planning: &PlanArguments, scheduler: Option<Scheduler>) -> Result<(), Failure> {
    let refused = |option: &str, of: &str, help: &str| {
        Err(Failure::input(
            format!("--{option} has no meaning for {of}"),
            Some(help.to_owned()),
        ))
    };
    let overview = "the overview of --plan";
    let a_script = "name what hands the shards out, such as --plan=slurm, or leave it away";
    match scheduler {
        None if planning.time.is_some() => refused("time", overview, a_script),
        None if planning.at_once.is_some() => refused("at-once", overview, a_script),
        Some(other) if other != Scheduler::Slurm && planning.array_limit.is_some() => {
            let of = "a script that is not for Slurm";
            refused("array-limit", of, "leave it away, or take --plan=slurm")
        }
        _ => Ok(()),
    }
}

impl Plan {
    fn of(study: &Study, planned: &Planned<'_>) -> Result<Self, Failure> {
        let (running, planning) = (planned.running, planned.planning);
        let runs = study.runs();
        let missing = study.missing_records().filter(|_| !running.keep_going);
        let mut notes: Vec<String> = missing.iter().map(ToString::to_string).collect();
        // More shards than chunks would leave some empty.
        let (asked, chunks) = (planning.shards as usize, runs.div_ceil(study.chunk));
        let shards = asked.min(chunks);
        if shards < asked {
            notes.push(format!(
                "{} instead of {asked}: {} in chunks of {} make {}; a smaller `chunk` in [output] makes more",
                counted(shards, "shard"),
                counted(runs, "run"),
                study.chunk,
                counted(chunks, "chunk")
            ));
        }
        let limit = planning.array_limit.unwrap_or(ARRAY_LIMIT);
        let most = limit as usize - 1;
        let tasks = shards.min(most);
        if tasks < shards {
            notes.push(format!(
                "for Slurm, {shards} shards in {tasks} tasks of {} or fewer, one after another: an array has {most} tasks at most where MaxArraySize is {} (`scontrol show config`), which --array-limit says",
                shards.div_ceil(tasks),
                limit
            ));
        }
        let time = planning.time.as_deref();
        let time = time.map(|t| time_limit(t, "time")).transpose()?;
        if let Some(seconds) = time.filter(|seconds| !(120.0..=3.0e7).contains(seconds)) {
            return Err(Failure::input(
                format!("--time: {seconds} s is no time limit of a task"),
                Some("give one from \"2 min\" to \"300 d\"".to_owned()),
            ));
        }
        let name = name(&study.file);
        let folder = planned.into.map_or_else(
            || path_word(Path::new(&format!("{name}.shards"))),
            path_word,
        );
        let program = program();
        let words = |words: &[&str]| words.iter().map(|w| (*w).to_owned()).collect::<Vec<_>>();
        let file = path_word(&study.file);
        let threads = running.threads.unwrap_or(1);
        let mut command = words(&[&program, planned.command, &file, "--into", &folder]);
        command.extend(words(&["--threads", &threads.to_string(), "--resume"]));
        command.extend(words(&["--store-every", &running.store_every]));
        let mut merge = words(&[&program, "merge", &folder, "-o"]);
        let output = running.output.as_deref();
        let output = output.map_or_else(|| path_word(&default_result(&study.file)), path_word);
        merge.push(output.clone());
        let mut last = words(&[&program, planned.command, &file, "-o", &output, "--resume"]);
        if running.keep_going {
            command.push("--keep-going".to_owned());
            last.push("--keep-going".to_owned());
        }
        let mut at_the_end = vec![merge];
        for (option, path) in [("--csv", &running.csv), ("--report", &running.report)] {
            if let Some(path) = path {
                last.extend(words(&[option, &path_word(path)]));
            }
        }
        last.extend(planned.at_the_end.iter().cloned());
        if planned.command != "sweep" || running.csv.is_some() || running.report.is_some() {
            // Goes on with the merged result: it finds all runs there.
            at_the_end.push(last);
        }
        Ok(Self {
            unfinished: words(&[&program, "status", &folder, "--unfinished"]),
            name,
            runs,
            chunk: study.chunk,
            shards,
            tasks,
            threads,
            time,
            at_once: planning.at_once,
            folder,
            here: std::env::current_dir()
                .unwrap_or_default()
                .display()
                .to_string(),
            command,
            at_the_end,
            notes,
        })
    }

    /// What varies, how many runs and shards, and how to get the scripts.
    fn overview(&self, study: &Study) -> String {
        let mut text = String::new();
        for (i, variable) in study.variables.iter().enumerate() {
            let shown = |run: usize| match study.point(run)[i] {
                Value::Number(x) => format!("{x} {}", variable.unit),
                Value::Choice(c) => study.label(i, c).to_owned(),
            };
            text.push_str(&format!(
                "{}: {} ... {}\n",
                variable.name,
                shown(0).trim_end(),
                shown(self.runs - 1).trim_end()
            ));
        }
        text.push_str(&format!(
            "{} in {}, dealt out in chunks of {}\nresults of shards: {}\n\nA shard:\n{}\n\nAt the end:\n{}\n\n--plan=slurm, --plan=hyper-queue, --plan=dask and --plan=shell print scripts that do all of this.\n",
            counted(self.runs, "run"),
            counted(self.shards, "shard"),
            self.chunk,
            self.folder,
            self.of_shard(&format!("1/{}", self.shards)),
            self.last_lines()
        ));
        text
    }

    /// The command of a shard, whose number is a word of a shell as it stands.
    fn of_shard(&self, shard: &str) -> String {
        format!("{} --shard {shard}", shell_line(&self.command))
    }

    /// The commands at the end, a line each.
    fn last_lines(&self) -> String {
        let lines: Vec<String> = self.at_the_end.iter().map(|c| shell_line(c)).collect();
        lines.join("\n")
    }

    /// The first lines of a script: what it is, and how it is called again.
    fn head(&self, what: &str, again: &str) -> String {
        let mut text = format!(
            "# {}: {} in {} of chunks of {}, {what}.\n",
            self.name.replace('\n', " "),
            counted(self.runs, "run"),
            counted(self.shards, "shard"),
            self.chunk
        );
        for note in &self.notes {
            text.push_str(&format!("# Note: {note}.\n"));
        }
        // A name of two lines would end the comment.
        let again = again.replace('\n', "?");
        text.push_str(&format!("# Again, what is missing only: {again}\n"));
        text
    }

    /// Goes to the folder of the study, and makes that of the results.
    fn begin(&self) -> String {
        format!(
            "set -eu\ncd {}\nmkdir -p {}\n",
            quoted(&self.here),
            quoted(&format!("{}/log", self.folder))
        )
    }

    /// Puts a list such as 3,7-9, or that of all shards, into a variable of a shell, and ends the script where it names
    /// shards that do not exist: nothing has been submitted then.
    fn list(&self) -> String {
        format!(
            r#"list=${{1-1-{shards}}}
set -f
for range in $(printf '%s\n' "$list" | tr , ' '); do
  first=${{range%%-*}}
  last=${{range#*-}}
  case $first$last in *[!0-9]*) last=0 ;; esac
  if ! {{ [ "$first" -ge 1 ] && [ "$first" -le "$last" ] && [ "$last" -le {shards} ]; }} 2>/dev/null; then
    echo "$range: no such shards; there are 1 to {shards}, give a list of their numbers such as {example}" >&2
    exit 1
  fi
done
set +f
"#,
            shards = self.shards,
            example = self.example()
        )
    }

    /// A list of numbers of shards that exist.
    fn example(&self) -> String {
        match self.shards {
            1 | 2 => "1".to_owned(),
            n => format!("1,{}-{n}", n - 1),
        }
    }

    /// As [`Plan::list`], and prints every number into a variable of its own.
    fn list_of_shards(&self) -> String {
        format!(
            "{}shards=$(for range in $(printf '%s\\n' \"$list\" | tr , ' '); do seq \"${{range%-*}}\" \"${{range#*-}}\"; done)\n",
            self.list()
        )
    }
}

/// A path as a word of a command: one that began with a dash would be taken for an option.
pub fn path_word(path: &Path) -> String {
    let word = path.display().to_string();
    match word.starts_with('-') {
        true => format!("./{word}"),
        false => word,
    }
}

/// The program as it was called: by its name where a shell finds it, else by its path.
pub fn program() -> String {
    let called = std::env::args_os().next().unwrap_or_default();
    let path = Path::new(&called);
    if path.components().count() < 2 {
        return called.to_string_lossy().into_owned();
    }
    let absolute = std::path::absolute(path).unwrap_or_else(|_| path.to_owned());
    absolute.display().to_string()
}
