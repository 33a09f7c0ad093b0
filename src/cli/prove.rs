//! `prove`: identities, proved on variables or checked at random points, and their twins disproved.

use std::io::Write;
use std::time::Instant;

use rayon::prelude::*;
use serde::Serialize;

use super::Format;
use super::exit::{Exit, Trouble};
use super::progress::Cases;
use crate::prove::{Identity, Size, catalogue};

const EXAMPLES: &str = "\
Examples:
  exact-kalman prove --list            what there is
  exact-kalman prove AK-L4.1iv         the identities that say this entry of SPEC.md
  exact-kalman prove WG --quick        those of a paper, at their smallest sizes
  exact-kalman prove AK-B.W --seed 7 --format json

docs/PROVE.md says what a proof here proves, and what a check at random points does not.
Exit codes: 0 all hold and all twins are disproved, 1 one does not, or a twin survives, 2 trouble";

/// Prove identities of SPEC.md by running the library's own code on variables
#[derive(clap::Args, Debug)]
#[command(after_help = EXAMPLES)]
pub(super) struct Prove {
    /// Identifiers of SPEC.md, or the letters of a paper. Without any: all identities.
    #[arg(value_name = "IDENTITY")]
    chosen: Vec<String>,
    /// Print the identities and run none.
    #[arg(long)]
    list: bool,
    /// Run the smallest size of each kind only.
    #[arg(long)]
    quick: bool,
    /// What determines the random points.
    #[arg(long, default_value_t = 1)]
    seed: u64,
    /// How to print the results.
    #[arg(long, value_enum, default_value_t)]
    format: Format,
}

/// One thing to run.
#[derive(Clone, Copy)]
enum Task {
    Proof(Size),
    Points(Size),
    Twin,
}

/// What one run found; a line for programs.
#[derive(Serialize)]
struct Line<'a> {
    identifiers: &'a [&'a str],
    name: &'a str,
    size: Option<String>,
    method: &'static str,
    holds: bool,
    variables: Option<usize>,
    terms: Option<usize>,
    points: Option<u32>,
    questions: Option<usize>,
    degree_bound: Option<String>,
    error_bound: Option<f64>,
    slip: Option<&'a str>,
    witness: Option<String>,
    failure: Option<String>,
    seconds: f64,
}

impl Prove {
    pub(super) fn run(self) -> Result<Exit, Trouble> {
        let all = catalogue();
        let chosen = self.select(&all)?;
        let mut out = std::io::stdout().lock();
        if self.list {
            for identity in chosen {
                match self.format {
                    Format::Text => list(&mut out, identity)?,
                    Format::Json => writeln!(out, "{}", listed(identity))?,
                }
            }
            return Ok(Exit::Clean);
        }
        let tasks: Vec<(&Identity, Task)> = chosen
            .iter()
            .flat_map(|&identity| self.tasks(identity).into_iter().map(move |task| (identity, task)))
            .collect();
        let (begun, progress) = (Instant::now(), Cases::of(tasks.len()));
        let lines: Vec<Line<'_>> = tasks
            .par_iter()
            .with_max_len(1)
            .map(|&(identity, task)| {
                progress.case(identity.name);
                let line = self.line(identity, task);
                progress.done();
                line
            })
            .collect();
        drop(progress);
        match self.format {
            Format::Json => {
                for line in &lines {
                    writeln!(out, "{}", serde_json::to_string(line).map_err(|error| Trouble::Output(error.into()))?)?;
                }
            }
            Format::Text => text(&mut out, &lines, begun.elapsed().as_secs_f64())?,
        }
        Ok(if lines.iter().all(|line| line.holds) { Exit::Clean } else { Exit::Findings })
    }

    fn select<'a>(&self, all: &'a [Identity]) -> Result<Vec<&'a Identity>, Trouble> {
        let is_meant = |identity: &Identity, id: &str| {
            identity.identifiers.iter().any(|own| {
                own.eq_ignore_ascii_case(id)
                    || own.split_once('-').is_some_and(|(paper, _)| paper.eq_ignore_ascii_case(id))
            })
        };
        for id in &self.chosen {
            if !all.iter().any(|identity| is_meant(identity, id)) {
                let message = "no identity says this; `exact-kalman prove --list` has all that are run".to_owned();
                return Err(Trouble::Other { place: id.clone(), message });
            }
        }
        let is_chosen =
            |identity: &&Identity| self.chosen.is_empty() || self.chosen.iter().any(|id| is_meant(identity, id));
        Ok(all.iter().filter(is_chosen).collect())
    }

    fn tasks(&self, identity: &Identity) -> Vec<Task> {
        let most = if self.quick { 1 } else { usize::MAX };
        let proofs = identity.symbolic.iter().chain(&identity.heavy).take(most).map(|&size| Task::Proof(size));
        let points = identity.random.iter().take(most).map(|&size| Task::Points(size));
        proofs.chain(points).chain([Task::Twin]).collect()
    }

    fn line<'a>(&self, identity: &'a Identity, task: Task) -> Line<'a> {
        let begun = Instant::now();
        let mut line = Line {
            identifiers: identity.identifiers,
            name: identity.name,
            size: None,
            method: "twin",
            holds: true,
            variables: None,
            terms: None,
            points: None,
            questions: None,
            degree_bound: None,
            error_bound: None,
            slip: None,
            witness: None,
            failure: None,
            seconds: 0.0,
        };
        let failure = match task {
            Task::Proof(size) => {
                line.size = Some(size.to_string());
                line.method = "rational functions";
                identity.proved(size).map(|proof| {
                    line.variables = Some(proof.variables);
                    line.terms = Some(proof.terms);
                })
            }
            Task::Points(size) => {
                line.size = Some(size.to_string());
                line.method = "random points";
                identity.chance(size, self.seed).map(|chance| {
                    line.points = Some(chance.points);
                    line.questions = Some(chance.questions);
                    line.degree_bound = Some(chance.degree.to_string());
                    line.error_bound = chance.decimal().parse().ok();
                })
            }
            Task::Twin => {
                line.slip = Some(identity.slip);
                identity.twin_disproved().map(|witness| line.witness = Some(witness.to_string()))
            }
        };
        if let Err(failure) = failure {
            line.holds = false;
            line.failure = Some(failure.to_string());
        }
        line.seconds = begun.elapsed().as_secs_f64();
        line
    }
}

fn sizes(sizes: &[Size]) -> String {
    sizes.iter().map(ToString::to_string).collect::<Vec<_>>().join("; ")
}

fn list(out: &mut impl Write, identity: &Identity) -> std::io::Result<()> {
    writeln!(out, "{} · {}", identity.identifiers.join(", "), identity.name)?;
    writeln!(out, "  where                 {}", identity.hypothesis)?;
    writeln!(out, "  proved for            {}", sizes(&[&identity.symbolic[..], &identity.heavy].concat()))?;
    writeln!(out, "  at random points for  {}", sizes(&identity.random))?;
    writeln!(out, "  the twin's slip       {}", identity.slip)
}

fn listed(identity: &Identity) -> serde_json::Value {
    let all = |sizes: &[Size]| sizes.iter().map(ToString::to_string).collect::<Vec<_>>();
    serde_json::json!({
        "identifiers": identity.identifiers,
        "name": identity.name,
        "where": identity.hypothesis,
        "proved": all(&[&identity.symbolic[..], &identity.heavy].concat()),
        "random_points": all(&identity.random),
        "slip": identity.slip,
    })
}

fn text(out: &mut impl Write, lines: &[Line<'_>], seconds: f64) -> Result<(), Trouble> {
    let longest = lines.iter().filter_map(|line| line.size.as_ref()).map(|size| size.chars().count()).max();
    let wide = longest.unwrap_or(0).max("twin".len());
    let mut last = "";
    for line in lines {
        if line.name != last {
            writeln!(out, "{} · {}", line.identifiers.join(", "), line.name)?;
            last = line.name;
        }
        let size = line.size.as_deref().unwrap_or("twin");
        let (verdict, detail) = match line {
            Line { failure: Some(failure), .. } => ("FAILS".to_owned(), failure.clone()),
            Line { terms: Some(terms), variables: Some(variables), .. } => {
                ("proved".to_owned(), format!("{variables} variables, {terms} terms"))
            }
            Line { points: Some(points), error_bound: Some(bound), .. } => (
                format!("holds at {points} random points"),
                format!("if wrong, it would pass with probability ≤ {bound:e}"),
            ),
            _ => ("disproved".to_owned(), format!("at {}", line.witness.as_deref().unwrap_or("a point"))),
        };
        writeln!(out, "  {size:wide$} {verdict:26} {:6.2} s  {detail}", line.seconds)?;
        if let Some(slip) = line.slip {
            writeln!(out, "  {:wide$} its slip: {slip}", "")?;
        }
    }
    let count = |method: &str| lines.iter().filter(|line| line.method == method && line.holds).count();
    let failed = lines.iter().filter(|line| !line.holds).count();
    writeln!(
        out,
        "{} proofs, {} checks at random points, {} twins disproved, {failed} failures, in {seconds:.1} s",
        count("rational functions"),
        count("random points"),
        count("twin"),
    )?;
    Ok(())
}
