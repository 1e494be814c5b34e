# A sentence of thirty words has a place here, because the check must know the difference between the longest that is
# allowed and the first one that is too long.
# One of thirty-one words must be found, because the check has to know the difference between the longest that is
# allowed here and the first one that is a word longer.

# Of a thing nothing is said first.
true

# All, but for one, are right.
true

# One; two; three semicolons apart.
