// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <numeric>
#include <vector>

namespace capfrac {

/// Disjoint sets of 0 … n-1 (union by smallest member, path halving; no recursion).
/// The smallest member represents its set, so that labels do not depend on the order of the joins.
class UnionFind {
public:
	explicit UnionFind(int n)
	        : parent(n)
	{
		std::iota(parent.begin(), parent.end(), 0);
	}

	int find(int i)
	{
		while (parent[i] != i)
			i = parent[i] = parent[parent[i]];
		return i;
	}

	/// Joins the sets of i and j; false if they were one already.
	bool join(int i, int j)
	{
		i = find(i), j = find(j);
		if (i == j) return false;
		if (i < j)
			parent[j] = i;
		else
			parent[i] = j;
		return true;
	}

private:
	std::vector<int> parent;
};

} // namespace capfrac
