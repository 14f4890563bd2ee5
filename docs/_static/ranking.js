// Sphinx's scores of search results, with the pages of learners before those of teachers, and the set-up first.
var Scorer = {
  score: ([page, , , , score]) =>
    score + (/^learn\//.test(page) ? 15 : /^lessons\//.test(page) ? 10 : /^(teach|about)\//.test(page) ? -10 : 0),
  objNameMatch: 11,
  objPartialMatch: 6,
  objPrio: { 0: 15, 1: 5, 2: -5 },
  objPrioDefault: 0,
  title: 15,
  partialTitle: 7,
  term: 5,
  partialTerm: 2,
};
