//! The pages that texts on keys lead to.

/// Name, then the page from the repository's root, with the heading.
pub(super) const LINKS: [(&str, &str); 24] = [
    ("absorbing", "docs/theory/absorbing-sides.md"),
    ("bubble", "docs/theory/bubble-content.md"),
    ("conduction", "docs/theory/conduction.md"),
    ("eos", "docs/theory/equations-of-state.md"),
    ("far-field", "docs/theory/far-field.md"),
    ("far-sides", "docs/verification/distant-sides.md"),
    ("film", "docs/theory/near-wall.md"),
    ("gravity", "docs/theory/gravity.md"),
    ("hits", "docs/guide/damage.md#many-hits"),
    ("interest", "docs/theory/region-of-interest.md"),
    ("levels", "docs/theory/local-time-steps.md"),
    ("models", "docs/theory/two-phase-models.md"),
    ("paper-schemes", "docs/theory/coupling-schemes.md"),
    ("participants", "docs/guide/own-solver.md"),
    ("phase-change", "docs/theory/phase-change.md"),
    ("plasticity", "docs/theory/plasticity.md"),
    ("refine", "docs/verification/convergence.md#the-grids"),
    ("reset", "docs/theory/bubble-content.md#the-cut-at-the-largest-radius"),
    ("sensors", "docs/reference/output-histories.md#sensors-every-step-sensorsname"),
    ("start", "docs/reference/cases.md#the-pressure-of-the-start"),
    ("steps", "docs/theory/time-steps.md#steps-of-their-own"),
    ("surface", "docs/reference/output-summary.md#the-surface-of-the-solid"),
    ("surface-tension", "docs/theory/surface-tension.md"),
    ("thresholds", "docs/theory/choosing-epsilon.md"),
];

/// The page of a name.
pub(super) fn page(name: &str) -> Option<&'static str> {
    LINKS.iter().find(|(known, _)| *known == name).map(|(_, page)| *page)
}

/// A page as the page on keys leads to it, which is in `docs/reference`.
pub(super) fn from_page(page: &str) -> String {
    match page.strip_prefix("docs/reference/") {
        Some(neighbour) => neighbour.to_owned(),
        None => page.replacen("docs/", "../", 1),
    }
}

/// A text with `[words][name]` replaced by what is made of the words and the page.
pub(super) fn replaced(text: &str, mut made: impl FnMut(&str, &'static str) -> String) -> String {
    let mut done = String::new();
    let mut rest = text;
    while let Some((before, after)) = rest.split_once("][") {
        let (name, behind) = after.split_once(']').unwrap_or((after, ""));
        let (plain, words) = before.rsplit_once('[').unwrap_or(("", before));
        done += plain;
        match page(name) {
            Some(page) => done += &made(words, page),
            None => done += words,
        }
        rest = behind;
    }
    done + rest
}
