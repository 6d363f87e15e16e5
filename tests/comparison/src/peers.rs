//! Results of tools outside this run, measured elsewhere: lines of comma-separated values.

use std::time::Duration;

/// One line.
pub(crate) struct Peer {
    pub(crate) tool: String,
    pub(crate) problem: String,
    pub(crate) error: f64,
    pub(crate) time: Duration,
}

/// Reads the columns `tool`, `problem`, `error_phi` and `microseconds`, in any order, beside others.
///
/// # Errors
/// In words: the column that is missing, or the line that does not hold a number where one should be.
pub(crate) fn read(text: &str) -> Result<Vec<Peer>, String> {
    let mut lines = csv::ReaderBuilder::new().flexible(true).from_reader(text.as_bytes());
    let head = lines.headers().map_err(|error| error.to_string())?.clone();
    let column = |name: &str| {
        head.iter()
            .position(|cell| cell == name)
            .ok_or(format!("there is no column `{name}` in the first line"))
    };
    let (tool, problem) = (column("tool")?, column("problem")?);
    let (error, time) = (column("error_phi")?, column("microseconds")?);
    let mut peers = Vec::new();
    for line in lines.records() {
        let line = line.map_err(|error| error.to_string())?;
        let at = line.position().map_or(0, csv::Position::line);
        let cell = |column: usize| line.get(column).unwrap_or_default();
        let number = |column: usize| {
            let wrong = || format!("line {at}: `{}` is no number, {} should be", cell(column), &head[column]);
            cell(column).parse::<f64>().map_err(|_| wrong())
        };
        let time = Duration::try_from_secs_f64(1e-6 * number(time)?)
            .map_err(|_| format!("line {at}: a run time is not negative"))?;
        let (tool, problem) = (cell(tool).to_owned(), cell(problem).to_owned());
        peers.push(Peer { tool, problem, error: number(error)?, time });
    }
    Ok(peers)
}

#[cfg(test)]
mod tests {
    use super::read;

    #[test]
    fn columns_are_found_by_name() {
        let text = "problem,tool,steps,microseconds,error_phi\nP2,heyoka,12,784,1e-12\n\nP3,\"heyoka, fast\",,1.5,2e-3\n";
        let peers = read(text).unwrap_or_default();
        let found: Vec<_> =
            peers.iter().map(|p| (p.tool.as_str(), p.problem.as_str(), p.error, p.time.as_nanos())).collect();
        assert_eq!(found, [("heyoka", "P2", 1e-12, 784_000), ("heyoka, fast", "P3", 2e-3, 1_500)]);
    }

    #[test]
    fn what_is_wrong_is_said() {
        let told = |text: &str| read(text).err().unwrap_or_default();
        assert_eq!(told("tool,problem,microseconds\n"), "there is no column `error_phi` in the first line");
        assert_eq!(
            told("tool,problem,microseconds,error_phi\na,P1,fast,1\n"),
            "line 2: `fast` is no number, microseconds should be"
        );
        assert_eq!(
            told("tool,problem,microseconds,error_phi\na,P1,-1,1\n"),
            "line 2: a run time is not negative"
        );
    }
}
