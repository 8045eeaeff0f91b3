(** * Every rule that is exact on polynomials has an order

    Claim.  If a rule with nodes in [0, 1] integrates (x - 1/2)^k over [0, 1]
    exactly for every k < m, then its error on a panel of width h is at most

      ((1/2)^m / (m + 1)! + sum_i |w_i| |c_i - 1/2|^m / m!) M h^(m + 1),

    where M bounds the m-th derivative of the integrand on the panel.  Hence Boole
    and Gauss-Legendre with 3 points have order 6, with 2 points order 4.

    Source.  Textbook numerical analysis: the integrand is replaced by its Taylor
    polynomial about the panel's centre, which costs the first term in the
    integral and the second in the rule.

    Assumptions.  As in Quadrature.v; m >= 1.  Weights may be negative.

    Not claimed.  That these constants are the best: they are not. *)

From Coq Require Import Reals Lra Lia List.
From Coquelicot Require Import Coquelicot.
From Volver Require Import Sums Derivatives Quadrature.
Import ListNotations.
Open Scope R_scope.

(** The right-hand side is the integral of (x - 1/2)^k over [0, 1]. *)
Definition exact_below (Q : rule) (m : nat) : Prop :=
  forall k, (k < m)%nat ->
  sum_over Q (fun '(c, w) => w * (c - 1/2) ^ k)
  = ((1/2) ^ (k + 1) - (- (1/2)) ^ (k + 1)) / INR (k + 1).

Definition taylor_constant (Q : rule) (m : nat) : R :=
  (1/2) ^ m / INR (fact (m + 1))
  + sum_over Q (fun '(c, w) => Rabs w * Rabs (c - 1/2) ^ m) / INR (fact m).

(** The polynomial of n terms about m, at m + u. *)
Fixpoint taylor (n : nat) (f : nat -> R -> R) (m u : R) : R :=
  match n with
  | O => 0
  | S k => taylor k f m u + f k m * taylor_term k u
  end.

Lemma taylor_at_centre (n : nat) (f : nat -> R -> R) (m : R) : taylor (S n) f m 0 = f 0%nat m.
Proof.
  induction n as [| n IH]; [unfold taylor, taylor_term; simpl; field |].
  change (taylor (S n) f m 0 + f (S n) m * taylor_term (S n) 0 = f 0%nat m).
  rewrite IH, taylor_term_0. ring.
Qed.

Lemma taylor_derivative (n : nat) (f : nat -> R -> R) (m u : R) :
  is_derive (taylor (S n) f m) u (taylor n (fun k => f (S k)) m u).
Proof.
  induction n as [| n IH].
  - apply (is_derive_ext (fun _ => f 0%nat m)).
    + intros t. unfold taylor, taylor_term. simpl. field.
    + apply (is_derive_const (V := R_NormedModule)).
  - apply (is_derive_plus (V := R_NormedModule) (taylor (S n) f m)); [exact IH |].
    apply is_derive_scal, taylor_term_derivative.
Qed.

(** Taylor's theorem forwards from m and, as s = -1, backwards. *)
Lemma taylor_remainder_one_side (n : nat) (f : nat -> R -> R) (s m h M : R) :
  Rabs s = 1 -> 0 <= h ->
  (forall k u, (k < n)%nat -> 0 <= u <= h -> is_derive (f k) (m + s * u) (f (S k) (m + s * u))) ->
  (forall u, 0 <= u <= h -> Rabs (f n (m + s * u)) <= M) ->
  Rabs (f 0%nat (m + s * h) - taylor n f m (s * h)) <= M * taylor_term n h.
Proof.
  intros abs_s. revert f h. induction n as [| n IH]; intros f h Hh Hf HM.
  - replace (taylor 0 f m (s * h)) with 0 by easy.
    replace (M * taylor_term 0 h) with M by (unfold taylor_term; simpl; field).
    rewrite Rminus_0_r. apply HM. lra.
  - apply (bound_from_derivative (fun u => f 0%nat (m + s * u) - taylor (S n) f m (s * u))
      (fun u => s * (f 1%nat (m + s * u) - taylor n (fun k => f (S k)) m (s * u)))); [easy | | |].
    + intros u Hu. assert (Hf0 := Hf 0%nat u (Nat.lt_0_succ n) Hu).
      assert (HT := taylor_derivative n f m (s * u)).
      replace (s * _) with (s * f 1%nat (m + s * u) - s * taylor n (fun k => f (S k)) m (s * u))
        by ring.
      apply (is_derive_minus (V := R_NormedModule)).
      * apply (is_derive_comp (V := R_NormedModule) (f 0%nat) (fun u => m + s * u)); [exact Hf0 |].
        auto_derive; [easy | ring].
      * apply (is_derive_comp (V := R_NormedModule) (taylor (S n) f m) (fun u => s * u));
          [exact HT | auto_derive; [easy | ring]].
    + rewrite Rmult_0_r, taylor_at_centre, Rplus_0_r. ring.
    + intros u Hu. rewrite Rabs_mult, abs_s, Rmult_1_l.
      apply (IH (fun k => f (S k))); [lra | |].
      * intros k v Hk Hv. apply Hf; [lia | lra].
      * intros v Hv. apply HM. lra.
Qed.

Lemma taylor_remainder (n : nat) (f : nat -> R -> R) (m h M u : R) :
  derivatives n f (m - h) (m + h) ->
  (forall x, m - h <= x <= m + h -> Rabs (f n x) <= M) -> - h <= u <= h ->
  Rabs (f 0%nat (m + u) - taylor n f m u) <= M * taylor_term n (Rabs u).
Proof.
  intros Hf HM Hu. destruct (Rle_dec 0 u) as [Hpos | Hneg].
  - rewrite (Rabs_pos_eq u) by easy. rewrite <- (Rmult_1_l u) at 1 2.
    apply taylor_remainder_one_side; [apply Rabs_R1 | easy | |].
    + intros k v Hk Hv. apply Hf; [easy | lra].
    + intros v Hv. apply HM. lra.
  - rewrite (Rabs_left u) by lra. replace u with (-1 * - u) at 1 2 by ring.
    apply taylor_remainder_one_side; [rewrite Rabs_left; lra | lra | |].
    + intros k v Hk Hv. apply Hf; [easy | lra].
    + intros v Hv. apply HM. lra.
Qed.

Lemma odd_term (n : nat) (u : R) :
  taylor_term (S n) u - taylor_term (S n) (- u)
  = 2 * u * ((2 * u) ^ n / INR (fact n)
    * (((1/2) ^ (n + 1) - (- (1/2)) ^ (n + 1)) / INR (n + 1))).
Proof.
  replace (taylor_term (S n) u) with (taylor_term (S n) (1/2 * (2 * u))) by (f_equal; field).
  replace (taylor_term (S n) (- u)) with (taylor_term (S n) (- (1/2) * (2 * u)))
    by (f_equal; field).
  replace (n + 1)%nat with (S n) by lia. generalize (2 * u). intros v.
  unfold taylor_term. rewrite fact_simpl, mult_INR, !Rpow_mult_distr.
  change (v ^ S n) with (v * v ^ n).
  field. split; [now apply not_0_INR | apply INR_fact_neq_0].
Qed.

(** The rule is exact on Taylor polynomials about the centre; u is half the width. *)
Lemma exact_on_taylor (Q : rule) (n : nat) (F : nat -> R -> R) (m u : R) :
  exact_below Q n ->
  taylor (S n) F m u - taylor (S n) F m (- u)
  = 2 * u * sum_over Q (fun '(c, w) => w * taylor n (fun k => F (S k)) m ((c - 1/2) * (2 * u))).
Proof.
  set (G := fun k => F (S k)). intros HQ. induction n as [| n IH].
  - replace (sum_over Q _) with (0 * sum_over Q (fun _ => 0)).
    + unfold taylor, taylor_term. simpl. field.
    + rewrite <- sum_over_scal. apply sum_over_ext. intros [c w] _. simpl. ring.
  - replace (sum_over Q _) with
      (sum_over Q (fun '(c, w) => w * taylor n G m ((c - 1/2) * (2 * u)))
       + G n m * (2 * u) ^ n / INR (fact n) * sum_over Q (fun '(c, w) => w * (c - 1/2) ^ n)).
    + rewrite HQ by lia. rewrite Rmult_plus_distr_l, <- IH.
      2: { intros k Hk. apply HQ. lia. }
      change (taylor (S (S n)) F m u) with (taylor (S n) F m u + G n m * taylor_term (S n) u).
      change (taylor (S (S n)) F m (- u))
        with (taylor (S n) F m (- u) + G n m * taylor_term (S n) (- u)).
      replace (_ - (_ + _)) with (taylor (S n) F m u - taylor (S n) F m (- u)
        + G n m * (taylor_term (S n) u - taylor_term (S n) (- u))) by ring.
      rewrite odd_term. unfold Rdiv. ring.
    + rewrite <- sum_over_scal, sum_over_plus. apply sum_over_ext. intros [c w] _.
      change (taylor (S n) G m ?x) with (taylor n G m x + G n m * taylor_term n x).
      unfold taylor_term. rewrite (Rpow_mult_distr (c - 1/2)). field. apply INR_fact_neq_0.
Qed.

Theorem exact_rule_panel (Q : rule) (m : nat) :
  (1 <= m)%nat -> (forall c w, In (c, w) Q -> 0 <= c <= 1) -> exact_below Q m ->
  panel_bound Q m (taylor_constant Q m).
Proof.
  intros Hm Hnodes Hexact. apply panel_bound_from_centre; [easy |]. intros F a u M Hu HF HM.
  set (G := fun k => F (S k)). change (F 1%nat) with (G 0%nat).
  set (T c := taylor m G a ((c - 1/2) * (2 * u))).
  set (node c := a - u + c * (2 * u)).
  (* what the rule makes of the integrand less its polynomial *)
  set (rest := 2 * u * sum_over Q (fun '(c, w) => w * (G 0%nat (node c) - T c))).
  assert (split_rule : apply_rule Q (G 0%nat) (a - u) (2 * u)
    = taylor (S m) F a u - taylor (S m) F a (- u) + rest).
  { rewrite (exact_on_taylor Q m F a u Hexact). unfold rest, apply_rule.
    rewrite <- Rmult_plus_distr_l, sum_over_plus. f_equal. apply sum_over_ext.
    intros [c w] _. fold G. fold (T c). fold (node c). ring. }
  assert (front := taylor_remainder (S m) F a u M (- u) HF HM ltac:(lra)).
  assert (back := taylor_remainder (S m) F a u M u HF HM ltac:(lra)).
  rewrite Rabs_Ropp, (Rabs_pos_eq u) in front by easy. rewrite (Rabs_pos_eq u) in back by easy.
  assert (Hrest : Rabs rest <= 2 * u * sum_over Q (fun '(c, w) =>
    M * ((2 * u) ^ m / INR (fact m)) * (Rabs w * Rabs (c - 1/2) ^ m))).
  { unfold rest. rewrite Rabs_mult, (Rabs_pos_eq (2 * u)) by lra.
    apply Rmult_le_compat_l; [lra |].
    eapply Rle_trans; [apply sum_over_abs |]. apply sum_over_le. intros [c w] Hcw.
    assert (Hc := Hnodes c w Hcw).
    rewrite Rabs_mult, (Rmult_comm _ (Rabs w * _)), Rmult_assoc.
    apply Rmult_le_compat_l; [apply Rabs_pos |].
    assert (remainder := taylor_remainder m G a u M ((c - 1/2) * (2 * u))).
    replace (a + (c - 1/2) * (2 * u)) with (node c) in remainder by (unfold node; field).
    eapply Rle_trans; [apply remainder |].
    - intros k x Hk Hx. apply HF; [lia | easy].
    - exact HM.
    - split; nra.
    - unfold taylor_term. rewrite Rabs_mult, (Rabs_pos_eq (2 * u)), Rpow_mult_distr by lra.
      apply Req_le. field. apply INR_fact_neq_0. }
  rewrite sum_over_ext with (g := fun x => M * ((2 * u) ^ m / INR (fact m))
    * (let '(c, w) := x in Rabs w * Rabs (c - 1/2) ^ m)) in Hrest by (intros [c w] _; easy).
  rewrite sum_over_scal in Hrest.
  rewrite split_rule. unfold taylor_constant.
  replace (_ * M * (2 * u) ^ (m + 1)) with (2 * (M * taylor_term (S m) u) + 2 * u *
    (M * ((2 * u) ^ m / INR (fact m)) * sum_over Q (fun '(c, w) => Rabs w * Rabs (c - 1/2) ^ m))).
  2: { unfold taylor_term. replace (m + 1)%nat with (S m) by lia.
       replace (u ^ S m) with (u * (1/2 * (2 * u)) ^ m) by (simpl; do 2 f_equal; field).
       rewrite Rpow_mult_distr. change ((2 * u) ^ S m) with (2 * u * (2 * u) ^ m).
       field. split; apply INR_fact_neq_0. }
  unfold Rminus in front. apply Rabs_le_between in front, back, Hrest. apply Rabs_le.
  unfold Rminus in *. split; lra.
Qed.

Corollary boole_panel : panel_bound boole 6 (taylor_constant boole 6).
Proof.
  apply exact_rule_panel; [lia | |].
  - intros c w Hcw. simpl in Hcw.
    repeat destruct Hcw as [[= <- <-] | Hcw]; [lra .. | easy].
  - intros k Hk. destruct k as [| [| [| [| [| [| k]]]]]]; [simpl; field .. | lia].
Qed.

Lemma sqrt_fraction (x : R) : 0 <= x <= 1 -> 0 <= sqrt x <= 1 /\ sqrt x * sqrt x = x.
Proof.
  intros Hx. split; [split; [apply sqrt_pos |] | now apply sqrt_sqrt].
  rewrite <- sqrt_1. apply sqrt_le_1; lra.
Qed.

Corollary gauss_2_panel : panel_bound gauss_2 4 (taylor_constant gauss_2 4).
Proof.
  unfold gauss_2. destruct (sqrt_fraction (1/3)) as [Hs square]; [lra |].
  set (s := sqrt (1/3)) in *.
  apply exact_rule_panel; [lia | |].
  - intros c w Hcw. simpl in Hcw.
    repeat destruct Hcw as [[= <- <-] | Hcw]; [lra .. | easy].
  - intros k Hk. destruct k as [| [| [| [| k]]]]; [simpl; try field .. | lia].
    replace (_ + _) with (s * s / 4) by field. rewrite square. field.
Qed.

Corollary gauss_3_panel : panel_bound gauss_3 6 (taylor_constant gauss_3 6).
Proof.
  unfold gauss_3. destruct (sqrt_fraction (3/5)) as [Hs square]; [lra |].
  set (s := sqrt (3/5)) in *.
  apply exact_rule_panel; [lia | |].
  - intros c w Hcw. simpl in Hcw.
    repeat destruct Hcw as [[= <- <-] | Hcw]; [lra .. | easy].
  - intros k Hk. destruct k as [| [| [| [| [| [| k]]]]]]; [simpl; try field .. | lia].
    + replace (_ + _) with (5/36 * (s * s)) by field. rewrite square. field.
    + replace (_ + _) with (5/144 * (s * s) * (s * s)) by field. rewrite square. field.
Qed.
